// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "bot_core/pose_t.hpp"
#include "bot_core/rigid_transform_t.hpp"
#include "drivers/frame_source.hpp"
#include "geomap/rgbd_frame_t.hpp"
#include "messaging/channels.hpp"

namespace geomap::drivers {

/// @brief All that is said of one frame of a source, with the frame's utime.
struct FrameMessages {
  bot_core::rigid_transform_t camera_to_body;
  std::optional<bot_core::rigid_transform_t> truth_pose;
  std::optional<bot_core::pose_t> pose;
  geomap::rgbd_frame_t frame;

  /// @brief Hands them out as sink(channel, utime, message), the frame last: whoever has it, has
  /// what belongs to it.
  template <class Sink>
  void send(Sink&& sink) const {
    namespace channels = messaging::channels;
    const std::int64_t utime = frame.utime;
    sink(channels::kCameraToBody, utime, camera_to_body);
    if (truth_pose) sink(channels::kTruthPose, utime, *truth_pose);
    if (pose) sink(channels::kPose, utime, *pose);
    sink(channels::kRgbdFrame, utime, frame);
  }
};

/// @brief T_body_camera of a frame: its own, or that of a camera that looks ahead from the body's
/// origin.
Eigen::Isometry3d camera_mount_of(const SourceFrame& frame);

/// @brief The messages of a frame. TRUTH_POSE says frame.truth_T_world_camera, where there is one.
/// @param T_odom_body what POSE says, if anything.
/// @throws SourceError, naming the frame's origin, when its images do not decode or do not fit its
/// cameras.
FrameMessages to_messages(const SourceFrame& frame,
                          const std::optional<Eigen::Isometry3d>& T_odom_body);

}  // namespace geomap::drivers
