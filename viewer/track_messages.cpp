// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/track_messages.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "geometry/angles.hpp"
#include "messaging/convert_geometry.hpp"
#include "viewer/sound_geometry.hpp"

namespace geomap::viewer {
namespace {

constexpr double kLeastMotion = 0.01;   // between two poses that are kept [m]
constexpr double kLeastTurnDeg = 1.0;   // the same
constexpr std::size_t kEarlyInRow = 5;  // poses; fewer are late, more are another clock's
constexpr std::size_t kMostPoses = 100'000, kMostKeyframes = 1'000'000;

bool differs(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  const Eigen::AngleAxisd turn(a.linear().transpose() * b.linear());
  return (a.translation() - b.translation()).norm() > kLeastMotion ||
         turn.angle() > geometry::radians(kLeastTurnDeg);
}

// Every second pose is let go of, so that the path stays whole.
void thin_out(std::vector<TrackLayer::Pose>& poses) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < poses.size(); i += 2) poses[kept++] = poses[i];
  poses.resize(kept);
}

void keep(const TrackLayer::Pose& pose, std::vector<TrackLayer::Pose>& poses) {
  while (!poses.empty() && poses.back().utime >= pose.utime) poses.pop_back();
  if (!poses.empty() && !differs(poses.back().T_world_camera, pose.T_world_camera)) return;
  poses.push_back(pose);
  if (poses.size() > kMostPoses) thin_out(poses);
}

}  // namespace

Taken TrackUpdates::take_pose(const bot_core::rigid_transform_t& message, TrackLayer& layer) {
  const TrackLayer::Pose pose{message.utime, messaging::from_message(message)};
  if (!is_sound(pose.T_world_camera)) return Taken::kRefused;
  if (is_early(pose, layer)) return Taken::kNothing;
  keep(pose, layer.poses);
  layer.newest = pose;
  ++layer.stamp;
  return Taken::kChange;
}

// True for a pose that is late. With several early ones in a row the sender's clock has begun anew,
// and what was later by it is from a former run.
bool TrackUpdates::is_early(const TrackLayer::Pose& pose, TrackLayer& layer) {
  if (!layer.newest || pose.utime >= layer.newest->utime) {
    early_.clear();
    return false;
  }
  if (!early_.empty() && pose.utime <= early_.back().utime) early_.clear();
  early_.push_back(pose);
  if (early_.size() < kEarlyInRow) return true;
  std::vector<TrackLayer::Pose>& poses = layer.poses;
  while (!poses.empty() && poses.back().utime >= early_.front().utime) poses.pop_back();
  for (const TrackLayer::Pose& early : early_) keep(early, poses);
  early_.clear();
  return false;
}

Taken TrackUpdates::take_camera_to_body(const bot_core::rigid_transform_t& message,
                                        TrackLayer& layer) {
  const Eigen::Isometry3d T_body_camera = messaging::from_message(message);
  if (!is_sound(T_body_camera)) return Taken::kRefused;
  if (layer.T_body_camera && layer.T_body_camera->matrix() == T_body_camera.matrix()) {
    return Taken::kNothing;
  }
  layer.T_body_camera = T_body_camera;
  ++layer.stamp;
  return Taken::kChange;
}

Taken TrackUpdates::take_keyframe(const geomap::keyframe_t& message, TrackLayer& layer) {
  if (message.status != geomap::keyframe_t::ACCEPTED) return Taken::kNothing;
  const Eigen::Isometry3d T_world_camera = messaging::from_message(message.T_world_camera);
  const bool is_new = !layer.keyframes.contains(message.utime);
  if (!is_sound(T_world_camera) || (is_new && layer.keyframes.size() >= kMostKeyframes)) {
    return Taken::kRefused;
  }
  if (begins_anew(message)) {
    clear(layer);
    // Its pose came before it.
    if (layer.newest && layer.newest->utime == message.utime) layer.poses = {*layer.newest};
  }
  newest_ = {message.session, message.utime, message.iterations > 0};
  layer.keyframes.insert_or_assign(message.utime, T_world_camera);
  const geometry::CameraModel camera = messaging::from_message(message.frame.depth_camera);
  if (is_sound(camera)) layer.camera = camera;
  ++layer.stamp;
  return Taken::kChange;
}

// Where registration is switched off, and poses are taken as they are, no key frame is aligned.
bool TrackUpdates::begins_anew(const geomap::keyframe_t& message) const {
  if (!newest_) return false;
  const bool is_other_session = message.session != newest_->session;
  const bool is_aligned = message.iterations > 0;
  return (is_other_session && message.utime < newest_->utime) ||
         (!is_aligned && (is_other_session || newest_->is_aligned));
}

bool TrackUpdates::note_empty_map(TrackLayer& layer) {
  if (layer.keyframes.empty()) return false;
  clear(layer);
  return true;
}

void TrackUpdates::clear(TrackLayer& layer) {
  layer.keyframes.clear();
  layer.poses.clear();
  dropped_.clear();
  early_.clear();
  newest_.reset();
  ++layer.stamp;
}

Taken TrackUpdates::take_update(const geomap::keyframe_update_t& message, TrackLayer& layer) {
  std::vector<std::pair<std::int64_t, Eigen::Isometry3d>> corrections;
  for (const geomap::pose_correction_t& correction : message.corrections) {
    corrections.emplace_back(correction.keyframe,
                             messaging::from_message(correction.T_world_camera));
    if (!is_sound(corrections.back().second)) return Taken::kRefused;
  }
  for (const auto& [keyframe, T_world_camera] : corrections) {
    for (auto* poses : {&layer.keyframes, &dropped_}) {
      const auto found = poses->find(keyframe);
      if (found != poses->end()) found->second = T_world_camera;
    }
  }
  for (const std::int64_t keyframe : message.removed) {
    layer.keyframes.erase(keyframe);
    dropped_.erase(keyframe);
  }
  for (const std::int64_t keyframe : message.dropped) {
    if (auto node = layer.keyframes.extract(keyframe)) dropped_.insert(std::move(node));
  }
  for (const std::int64_t keyframe : message.restored) {
    if (auto node = dropped_.extract(keyframe)) layer.keyframes.insert(std::move(node));
  }
  ++layer.stamp;
  return Taken::kChange;
}

}  // namespace geomap::viewer
