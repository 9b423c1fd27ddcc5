// SPDX-License-Identifier: BSD-3-Clause
#include "perception/tracking_process.hpp"

#include "messaging/convert_frame.hpp"
#include "messaging/stopwatch.hpp"

namespace geomap::perception {

TrackerConfig read_tracker_config(const messaging::Config& config) {
  return {config.read<PriorConfig>("prior"), config.read<KeyframeConfig>("keyframes"),
          config.read<RegistrationConfig>("registration"),
          config.read<DepthCorrectionConfig>("depth_correction"),
          config.read<PointMapConfig>("point_map")};
}

void TrackingProcess::add_pose(std::int64_t utime, const Eigen::Isometry3d& T_odom_body) {
  tracker_.prior().add_pose(utime, T_odom_body);
  track_ready();
}

void TrackingProcess::add_camera_to_body(std::int64_t utime,
                                         const Eigen::Isometry3d& T_body_camera) {
  tracker_.prior().add_camera_to_body(utime, T_body_camera);
  track_ready();
}

void TrackingProcess::add_frame(geomap::rgbd_frame_t message) {
  ++frames_;
  tracker_.prior().note_input(message.utime);
  waiting_.push_back(std::move(message));
  track_ready();
}

void TrackingProcess::finish() {
  while (!waiting_.empty()) track_next();
}

void TrackingProcess::reset() {
  tracker_ = Tracker(config_);
  waiting_.clear();
}

void TrackingProcess::track_ready() {
  while (!waiting_.empty() && tracker_.prior().is_ready(waiting_.front().utime)) track_next();
}

void TrackingProcess::track_next() {
  TrackedFrame frame;
  frame.message = std::move(waiting_.front());
  waiting_.pop_front();
  messaging::FrameFault fault{};
  const auto image = [&]() -> const geometry::RgbdFrame* {
    const messaging::Stopwatch decoding;
    messaging::FrameResult decoded = messaging::to_frame(frame.message);
    fault = decoded.fault;
    frame.image = std::move(decoded.frame);
    frame.decode_seconds = decoding.seconds();
    return frame.image ? &*frame.image : nullptr;
  };
  const messaging::Stopwatch tracking;
  frame.tracked = tracker_.track(frame.message.utime, image);
  frame.registration_seconds = tracking.seconds() - frame.decode_seconds;
  if (frame.tracked.status == TrackStatus::kNoImage) {
    frame.tracked.reason = messaging::to_string(fault);
  }
  frame.T_world_odom = tracker_.prior().T_world_odom();
  listener_(std::move(frame));
}

}  // namespace geomap::perception
