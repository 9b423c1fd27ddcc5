// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/track_messages.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "geometry/angles.hpp"
#include "mapping/map_event.hpp"
#include "messaging/convert_geometry.hpp"

namespace geomap::viewer {
namespace {

using mapping::EventFault;

constexpr double kLeastMotion = 0.01;  // between two poses that are kept [m]
constexpr double kLeastTurnDeg = 1.0;  // the same
constexpr std::size_t kMostPoses = 100'000, kMostKeyframes = 1'000'000;

bool is_sound(const Eigen::Isometry3d& T) { return mapping::find_fault(T) == EventFault::kNone; }

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

}  // namespace

Taken TrackUpdates::take_pose(const bot_core::rigid_transform_t& message, TrackLayer& layer) {
  const TrackLayer::Pose pose{message.utime, messaging::from_message(message)};
  if (!is_sound(pose.T_world_camera)) return Taken::kRefused;
  std::vector<TrackLayer::Pose>& poses = layer.poses;
  // A sender whose clock is earlier has begun anew.
  while (!poses.empty() && poses.back().utime >= pose.utime) poses.pop_back();
  if (poses.empty() || differs(poses.back().T_world_camera, pose.T_world_camera)) {
    poses.push_back(pose);
    if (poses.size() > kMostPoses) thin_out(poses);
  }
  layer.newest = pose;
  ++layer.stamp;
  return Taken::kChange;
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
  layer.keyframes.insert_or_assign(message.utime, T_world_camera);
  const geometry::CameraModel camera = messaging::from_message(message.frame.depth_camera);
  if (camera.valid()) layer.camera = camera;
  ++layer.stamp;
  return Taken::kChange;
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
  for (const std::int64_t keyframe : message.removed) layer.keyframes.erase(keyframe);
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
