// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/frame_messages.hpp"

#include <cmath>
#include <memory>
#include <utility>

#include "messaging/convert_frame.hpp"

namespace geomap::viewer {
namespace {

constexpr std::int64_t kFarthestPose = 100'000;  // in time from the frame [us]
constexpr double kRestart = 2e6;                 // back in time: the sensor began anew [us]

}  // namespace

void NewestFrame::offer(const std::string& channel, const geomap::rgbd_frame_t& message,
                        const std::optional<Eigen::Isometry3d>& T_world_camera) {
  const double back =
      newest_ ? static_cast<double>(*newest_) - static_cast<double>(message.utime) : 0.0;
  if (back > 0.0 && back < kRestart) return;
  const bool is_known = newest_ == message.utime;
  if (!is_known) {
    waiting_ = {channel, message};
    T_world_camera_.reset();
    away_.reset();
  }
  newest_ = message.utime;
  if (T_world_camera) T_world_camera_ = T_world_camera;
}

bool NewestFrame::show(SceneModel& scene) {
  const bool is_new = decode(scene);
  const bool is_placed = place(scene);
  if (is_new || is_placed) ++scene.frame.stamp;
  return is_new || is_placed;
}

bool NewestFrame::decode(SceneModel& scene) {
  if (!waiting_) return false;
  const Waiting waiting = std::move(*waiting_);
  waiting_.reset();
  messaging::FrameResult result = messaging::to_frame(waiting.message);
  if (!result.frame) {
    ++scene.channels[waiting.channel].refused;
    return false;
  }
  scene.frame.frame = std::make_shared<const geometry::RgbdFrame>(std::move(*result.frame));
  scene.frame.T_world_camera.reset();
  return true;
}

// A pose of the very frame is better than one near it in time.
bool NewestFrame::place(SceneModel& scene) {
  const FrameLayer& layer = scene.frame;
  if (!layer.frame || layer.frame->utime != newest_ || away_ == 0) return false;
  std::optional<Eigen::Isometry3d> T_world_camera = T_world_camera_;
  std::int64_t away = 0;
  if (!T_world_camera && scene.track.newest) {
    const double apart =
        static_cast<double>(scene.track.newest->utime) - static_cast<double>(layer.frame->utime);
    away = std::abs(apart) <= kFarthestPose ? std::llabs(std::llround(apart)) : kFarthestPose + 1;
    T_world_camera = scene.track.newest->T_world_camera;
  }
  if (!T_world_camera || away > kFarthestPose || (away_ && away >= *away_)) return false;
  scene.frame.T_world_camera = T_world_camera;
  away_ = away;
  return true;
}

}  // namespace geomap::viewer
