// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/event_history.hpp"

#include <algorithm>
#include <utility>

namespace geomap::mapping {
namespace {

std::shared_ptr<const Observation> moved(const Observation& observation,
                                         const Eigen::Isometry3d& T_world_camera) {
  auto copy = std::make_shared<Observation>(observation);
  copy->T_world_camera = T_world_camera;
  return copy;
}

}  // namespace

EventHistory::Recorded EventHistory::record(const MapEvent& event) {
  const Recorded recorded = std::visit([this](const auto& e) { return add(e); }, event);
  if (recorded.fault == EventFault::kNone) events_.push_back(event);
  return recorded;
}

EventHistory::Recorded EventHistory::add(const std::shared_ptr<const Observation>& observation) {
  const std::int64_t id = observation->keyframe;
  if (is_forgotten(id)) return {EventFault::kCompacted, {}};
  if (removed_.contains(id)) return {EventFault::kRemoved, {}};
  if (keyframes_.contains(id)) return {EventFault::kAlreadyObserved, {}};
  const auto correction = corrected_.find(id);
  keyframes_.emplace(
      id, correction == corrected_.end() ? observation : moved(*observation, correction->second));
  return {EventFault::kNone, id};
}

EventHistory::Recorded EventHistory::add(const KeyframeRemoval& removal) {
  if (is_forgotten(removal.keyframe)) return {EventFault::kCompacted, {}};
  removed_.insert(removal.keyframe);
  if (keyframes_.erase(removal.keyframe) == 0) return {};
  return {EventFault::kNone, removal.keyframe};
}

EventHistory::Recorded EventHistory::add(const PoseCorrection& correction) {
  for (const auto& [id, pose] : correction.poses) {
    if (is_forgotten(id)) return {EventFault::kCompacted, {}};
  }
  Recorded recorded;
  for (const auto& [id, pose] : correction.poses) {
    corrected_[id] = pose;
    const auto found = keyframes_.find(id);
    if (found == keyframes_.end()) continue;
    found->second = moved(*found->second, pose);
    recorded.changed_from = std::min(recorded.changed_from.value_or(id), id);
  }
  return recorded;
}

void EventHistory::forget_through(std::int64_t keyframe) {
  forgotten_through_ = keyframe;
  keyframes_.erase(keyframes_.begin(), keyframes_.upper_bound(keyframe));
  removed_.erase(removed_.begin(), removed_.upper_bound(keyframe));
  corrected_.erase(corrected_.begin(), corrected_.upper_bound(keyframe));

  std::vector<MapEvent> kept;
  for (MapEvent& event : events_) {
    if (auto* correction = std::get_if<PoseCorrection>(&event)) {
      std::erase_if(correction->poses, [&](const auto& pose) { return pose.first <= keyframe; });
      if (!correction->poses.empty()) kept.push_back(std::move(event));
      continue;
    }
    const auto* observation = std::get_if<std::shared_ptr<const Observation>>(&event);
    const std::int64_t id =
        observation ? (*observation)->keyframe : std::get<KeyframeRemoval>(event).keyframe;
    if (id > keyframe) kept.push_back(std::move(event));
  }
  events_ = std::move(kept);
}

}  // namespace geomap::mapping
