// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "mapping/map_event.hpp"

namespace geomap::mapping {

/// @brief The events of a map, and what they amount to: one observation per key frame, with its
/// last corrected pose, without the removed ones.
///
/// Observations count in the order of their key frames, not of their arrival, so a map does not
/// depend on which of two messages was faster. Corrections and removals may arrive before the
/// observation they speak of.
class EventHistory {
 public:
  struct Recorded {
    EventFault fault = EventFault::kNone;
    std::optional<std::int64_t> changed_from;  // first key frame whose contribution changed
  };

  /// @brief Adds an event that passed find_fault(); a refused one leaves no trace.
  Recorded record(const MapEvent& event);

  /// @brief What each key frame contributes, by id.
  using Keyframes = std::map<std::int64_t, std::shared_ptr<const Observation>>;
  const Keyframes& keyframes() const { return keyframes_; }

  /// @brief Accepted events in order of arrival, without those that were forgotten.
  const std::vector<MapEvent>& events() const { return events_; }

  /// @brief Drops the events of all key frames up to this one; what would reach behind it is
  /// refused from then on.
  void forget_through(std::int64_t keyframe);
  /// @brief Last forgotten key frame, if any.
  std::optional<std::int64_t> forgotten_through() const { return forgotten_through_; }

 private:
  Recorded add(const std::shared_ptr<const Observation>& observation);
  Recorded add(const KeyframeRemoval& removal);
  Recorded add(const PoseCorrection& correction);
  bool is_forgotten(std::int64_t keyframe) const {
    return forgotten_through_ && keyframe <= *forgotten_through_;
  }

  std::vector<MapEvent> events_;
  Keyframes keyframes_;
  std::set<std::int64_t> removed_;
  std::map<std::int64_t, Eigen::Isometry3d> corrected_;
  std::optional<std::int64_t> forgotten_through_;
};

}  // namespace geomap::mapping
