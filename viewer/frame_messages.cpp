// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/frame_messages.hpp"

#include <cstddef>
#include <iterator>
#include <utility>

#include "messaging/convert_frame.hpp"
#include "viewer/sound_geometry.hpp"

namespace geomap::viewer {
namespace {

constexpr double kFarthestPose = 100e3;  // in time from the frame [us]
constexpr double kRestart = 2e6;         // back in time: the sensor began anew [us]
constexpr std::size_t kMostFrames = 8, kMostPoses = 64;

double apart(std::int64_t later, std::int64_t earlier) {
  return static_cast<double>(later) - static_cast<double>(earlier);  // a difference could overflow
}

template <class Value>
bool is_restart(const std::map<std::int64_t, Value>& known, std::int64_t utime) {
  return !known.empty() && apart(known.rbegin()->first, utime) > kRestart;
}

Eigen::Isometry3d interpolated(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b,
                               double share) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::Quaterniond(a.linear())
                   .slerp(share, Eigen::Quaterniond(b.linear()))
                   .toRotationMatrix();
  T.translation() = (1.0 - share) * a.translation() + share * b.translation();
  return T;
}

}  // namespace

void RecentFrames::offer(const std::string& channel, const geomap::rgbd_frame_t& message,
                         const std::optional<Eigen::Isometry3d>& T_world_camera) {
  if (is_restart(frames_, message.utime)) {
    frames_.clear();
    shown_newest_.reset();
    shown_placed_.reset();
  }
  const auto [found, is_new] = frames_.try_emplace(message.utime);
  if (is_new) {
    found->second.channel = channel;
    found->second.message = message;
  }
  if (T_world_camera) found->second.T_world_camera = T_world_camera;
  if (frames_.size() > kMostFrames) frames_.erase(frames_.begin());
}

void RecentFrames::note_pose(std::int64_t utime, const Eigen::Isometry3d& T_world_camera) {
  if (is_restart(poses_, utime)) poses_.clear();
  poses_.insert_or_assign(utime, T_world_camera);
  if (poses_.size() > kMostPoses) poses_.erase(poses_.begin());
}

bool RecentFrames::show(SceneModel& scene) {
  const bool is_newer = show_newest(scene);
  const bool is_placed = show_placed(scene);
  if (is_newer || is_placed) ++scene.frame.stamp;
  return is_newer || is_placed;
}

bool RecentFrames::show_newest(SceneModel& scene) {
  while (!frames_.empty() && shown_newest_ != frames_.rbegin()->first) {
    const auto newest = std::prev(frames_.end());
    if (shown_newest_ && newest->first < *shown_newest_) return false;
    if (decode(newest->second, scene)) {
      shown_newest_ = newest->first;
      scene.frame.newest = newest->second.decoded;
      return true;
    }
    frames_.erase(newest);
  }
  return false;
}

bool RecentFrames::show_placed(SceneModel& scene) {
  for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame) {
    const auto& [utime, found] = *frame;
    if (shown_placed_ && utime < *shown_placed_) return false;
    const auto T_world_camera = found.T_world_camera ? found.T_world_camera : pose_at(utime);
    if (!T_world_camera) continue;
    const bool is_known = shown_placed_ == utime && scene.frame.T_world_camera &&
                          scene.frame.T_world_camera->matrix() == T_world_camera->matrix();
    if (is_known) return false;
    if (!decode(frame->second, scene)) {
      frames_.erase(utime);
      return false;
    }
    shown_placed_ = utime;
    scene.frame.frame = frame->second.decoded;
    scene.frame.T_world_camera = T_world_camera;
    return true;
  }
  return false;
}

// What the message holds is not needed any more afterwards.
bool RecentFrames::decode(Frame& frame, SceneModel& scene) const {
  if (frame.decoded) return true;
  messaging::FrameResult result = messaging::to_frame(std::exchange(frame.message, {}));
  if (!result.frame) {
    ++scene.channels[frame.channel].refused;
    return false;
  }
  // Its images can be looked at nevertheless, only not be put into the world.
  if (!is_sound(result.frame->depth_camera)) result.frame->depth_camera = {};
  frame.decoded = std::make_shared<const geometry::RgbdFrame>(std::move(*result.frame));
  return true;
}

std::optional<Eigen::Isometry3d> RecentFrames::pose_at(std::int64_t utime) const {
  const auto after = poses_.lower_bound(utime);
  if (after == poses_.end()) return std::nullopt;
  if (after->first == utime) return after->second;
  if (after == poses_.begin()) return std::nullopt;
  const auto before = std::prev(after);
  const double since = apart(utime, before->first), until = apart(after->first, utime);
  if (since > kFarthestPose || until > kFarthestPose) return std::nullopt;
  return interpolated(before->second, after->second, since / (since + until));
}

}  // namespace geomap::viewer
