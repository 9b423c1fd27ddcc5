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
  const auto found = keyframes_.find(removal.keyframe);
  if (found == keyframes_.end()) return {};
  corrected_[removal.keyframe] = found->second->T_world_camera;
  keyframes_.erase(found);
  return {EventFault::kNone, removal.keyframe};
}

EventHistory::Recorded EventHistory::add(const PoseCorrection& correction) {
  for (const auto& [id, pose] : correction.poses) {
    if (is_forgotten(id)) return {EventFault::kCompacted, {}};
  }
  Recorded recorded;
  for (const auto& [id, pose] : correction.poses) {
    corrected_[id] = pose;
    // What hangs on a key frame moves with it, also when that was removed.
    for (const auto& [number, entry] : edits_.entries()) {
      if (entry.edit->anchor != id || !has_place_in_fold(entry.edit->kind)) continue;
      const std::int64_t from = entry.edit->after + 1;
      recorded.changed_from = std::min(recorded.changed_from.value_or(from), from);
    }
    const auto found = keyframes_.find(id);
    if (found == keyframes_.end()) continue;
    found->second = moved(*found->second, pose);
    recorded.changed_from = std::min(recorded.changed_from.value_or(id), id);
  }
  return recorded;
}

EventHistory::Recorded EventHistory::add(const std::shared_ptr<const Edit>& edit) {
  if (forgotten_through_ && edit->after < *forgotten_through_) return {EventFault::kCompacted, {}};
  if (edit->number <= edits_.last_number()) return {EventFault::kBadEdit, {}};
  Recorded recorded;
  for (const std::int64_t number : edits_.add(edit)) {
    const Edit& changed = *edits_.entries().at(number).edit;
    if (is_about_edits(changed.kind)) continue;
    const std::int64_t from =
        changed.kind == EditKind::kDropKeyframe ? changed.keyframe : changed.after + 1;
    recorded.changed_from = std::min(recorded.changed_from.value_or(from), from);
  }
  return recorded;
}

std::int64_t EventHistory::newest() const {
  std::int64_t newest = forgotten_through_.value_or(0);
  if (!keyframes_.empty()) newest = std::max(newest, keyframes_.rbegin()->first);
  for (const auto& [number, entry] : edits_.entries()) newest = std::max(newest, entry.edit->after);
  return newest;
}

std::optional<Eigen::Isometry3d> EventHistory::pose_of(std::int64_t keyframe) const {
  const auto observed = keyframes_.find(keyframe);
  if (observed != keyframes_.end()) return observed->second->T_world_camera;
  const auto last = corrected_.find(keyframe);
  if (last != corrected_.end()) return last->second;
  return std::nullopt;
}

void EventHistory::forget_through(std::int64_t keyframe) {
  forgotten_through_ = keyframe;
  edits_.forget_before(keyframe, [this](std::int64_t anchor) { return pose_of(anchor); });
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
    if (const auto* edit = std::get_if<std::shared_ptr<const Edit>>(&event)) {
      const auto known = edits_.entries().find((*edit)->number);
      if (known != edits_.entries().end()) kept.emplace_back(known->second.edit);
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
