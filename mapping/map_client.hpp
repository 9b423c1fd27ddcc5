// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "geomap/map_delta_t.hpp"
#include "geomap/map_t.hpp"
#include "mapping/map_view.hpp"

namespace geomap::mapping {

/// @brief The operator's end of the link: makes the mapper's view out of its messages, in whatever
/// order they come, and asks for a snapshot when some are missing.
///
/// Messages may be lost, doubled, late, from a mapper that was started anew, or from somebody who
/// wishes no good. The caller decodes them (safe_decode) and hands them in with the time.
class MapClient {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param request_snapshot is called at most once a second; publishes MAP_REQUEST.
  explicit MapClient(std::function<void()> request_snapshot);

  void take(const geomap::map_delta_t& message, Clock::time_point now);
  void take(const geomap::map_t& message, Clock::time_point now);
  /// @brief To be called several times a second: asks when it is time to.
  void poll(Clock::time_point now);

  /// @brief The newest complete view. That of a former mapper stays until the next one's is there.
  const MapView& view() const { return view_; }
  /// @brief Grows with every change of the view, so that nobody needs to compare whole maps.
  std::uint64_t changes() const { return changes_; }
  /// @brief True when nothing is known to be missing.
  bool is_current() const;
  /// @brief Messages that could not be used: not sound, or of a former mapper.
  std::int64_t refused() const { return refused_; }

 private:
  template <class Message>
  using Parts = std::map<std::int32_t, Message>;  // by part
  template <class Message>
  using Pending = std::map<std::int64_t, Parts<Message>>;  // by revision

  template <class Message>
  bool is_plausible(const Message& message, Clock::time_point now);
  bool follow(std::int64_t epoch, Clock::time_point now);
  template <class Message>
  bool collect(const Message& message, Pending<Message>& pending);
  void take_snapshot(std::int64_t revision);
  void apply_pending();
  void forget_pending();
  std::int64_t revision() const;

  std::function<void()> request_snapshot_;
  MapView view_;
  std::uint64_t changes_ = 0;
  std::optional<std::string> hash_;    // of view_, once it was needed
  std::optional<std::int64_t> epoch_;  // of the mapper that is followed
  Clock::time_point heard_;            // newest message of this epoch
  Pending<geomap::map_delta_t> deltas_;
  Pending<geomap::map_t> snapshots_;
  std::size_t pending_messages_ = 0;
  bool lost_ = false;  // something that only a snapshot can bring back
  std::optional<Clock::time_point> incomplete_since_, requested_;
  std::int64_t refused_ = 0;
};

}  // namespace geomap::mapping
