// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "mapping/edit_history.hpp"
#include "mapping/map_event.hpp"

namespace geomap::mapping {

/// @brief The events of a map, and what they amount to: one observation per key frame, with its
/// last corrected pose, without the removed ones.
///
/// Observations count in the order of their key frames, not of their arrival, so a map does not
/// depend on which of two messages was faster. Corrections and removals may arrive before the
/// observation they speak of. Edits keep their place behind the key frame that was the newest when
/// they were made.
class EventHistory {
 public:
  struct Recorded {
    EventFault fault = EventFault::kNone;
    std::optional<std::int64_t> changed_from;  // what was folded before this time [us] stays
  };

  /// @brief Adds an event that passed find_fault(); a refused one leaves no trace.
  Recorded record(const MapEvent& event);

  /// @brief What each key frame contributes, by id.
  using Keyframes = std::map<std::int64_t, std::shared_ptr<const Observation>>;
  const Keyframes& keyframes() const { return keyframes_; }
  const EditHistory& edits() const { return edits_; }
  /// @brief Numbers up to this one were given to edits that were forgotten.
  void number_edits_after(std::int64_t number) { edits_.number_after(number); }

  /// @brief Where the next edit has its place: behind the newest key frame and every edit.
  std::int64_t newest() const;
  /// @brief T_world_camera of a key frame as far as it is known, also of a removed one.
  std::optional<Eigen::Isometry3d> pose_of(std::int64_t keyframe) const;

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
  Recorded add(const std::shared_ptr<const Edit>& edit);
  bool is_forgotten(std::int64_t keyframe) const {
    return forgotten_through_ && keyframe <= *forgotten_through_;
  }

  std::vector<MapEvent> events_;
  Keyframes keyframes_;
  std::set<std::int64_t> removed_;
  std::map<std::int64_t, Eigen::Isometry3d> corrected_;  // also the last poses of removed ones
  EditHistory edits_;
  std::optional<std::int64_t> forgotten_through_;
};

}  // namespace geomap::mapping
