// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <set>

#include "geomap/point_map_update_t.hpp"
#include "viewer/scene_model.hpp"
#include "viewer/taken.hpp"

namespace geomap::viewer {

/// @brief The point map, put together from the updates of POINT_MAP.
///
/// When the whole map comes anew, a block that is not in it stays for an instant longer than it
/// must, so that the picture does not flicker while the updates come in.
class PointUpdates {
 public:
  Taken take(const geomap::point_map_update_t& message, Clock::time_point now, PointLayer& layer);

  /// @brief Takes out what a whole map that has come does not hold. @return true when there was.
  bool drop_outdated(Clock::time_point now, PointLayer& layer);

  /// @brief Something is missing, for example since the sender was started anew.
  void note_loss() { is_whole_ = false; }
  /// @brief True when it is time to ask for the whole map: when something is missing, at most once
  /// a second, and ever more seldom while nobody answers.
  bool should_ask(Clock::time_point now);

  /// @brief Updates that are missing by their numbers.
  std::int64_t missing() const { return missing_; }

 private:
  bool follow(const geomap::point_map_update_t& message);

  std::optional<std::int64_t> sequence_;  // of the newest update
  std::int64_t session_ = 0;
  std::int64_t missing_ = 0;
  bool is_whole_ = false;
  Clock::duration patience_ = std::chrono::seconds(1);  // until the next request
  std::optional<Clock::time_point> asked_;
  std::set<BlockKey> outdated_;  // of the former map, and not yet in the new one
  Clock::time_point heard_;
};

}  // namespace geomap::viewer
