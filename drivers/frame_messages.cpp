// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/frame_messages.hpp"

#include <stdexcept>

#include "drivers/camera_mount.hpp"
#include "messaging/convert_frame.hpp"
#include "messaging/convert_geometry.hpp"
#include "messaging/jpeg.hpp"

namespace geomap::drivers {
namespace {

geomap::rgbd_frame_t frame_message(const SourceFrame& frame) {
  // Whoever replays the log would lose this frame: better said now.
  if (!frame.jpeg.empty() && !messaging::decode_jpeg(frame.jpeg)) {
    throw SourceError(frame.origin + ": its JPEG colour image does not decode");
  }
  try {
    return messaging::to_message(frame.frame, frame.jpeg);
  } catch (const std::invalid_argument& error) {
    throw SourceError(frame.origin + ": " + error.what());
  }
}

}  // namespace

Eigen::Isometry3d camera_mount_of(const SourceFrame& frame) {
  return frame.T_body_camera ? *frame.T_body_camera : forward_camera_mount();
}

FrameMessages to_messages(const SourceFrame& frame,
                          const std::optional<Eigen::Isometry3d>& T_odom_body) {
  const std::int64_t utime = frame.frame.utime;
  FrameMessages messages;
  messages.frame = frame_message(frame);
  messages.camera_to_body = messaging::to_rigid_transform(utime, camera_mount_of(frame));
  if (frame.truth_T_world_camera) {
    messages.truth_pose = messaging::to_rigid_transform(utime, *frame.truth_T_world_camera);
  }
  if (T_odom_body) messages.pose = messaging::to_pose(utime, *T_odom_body);
  return messages;
}

}  // namespace geomap::drivers
