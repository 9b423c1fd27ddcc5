// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "geomap/keyframe_t.hpp"
#include "messaging/channels.hpp"
#include "messaging/convert_geometry.hpp"
#include "perception/registration.hpp"
#include "perception/tracking_process.hpp"

namespace geomap::perception {

/// @brief A registered frame as the channel KEYFRAME carries it.
/// @param frame as it was received; its images are left out when the registration was rejected.
/// @param session of the publisher; @param sequence of its key frames, rejected ones included.
geomap::keyframe_t to_message(const RegistrationResult& registration,
                              const geomap::rgbd_frame_t& frame, std::int64_t session,
                              std::int64_t sequence);

/// @brief What registration publishes of each tracked frame.
class TrackingMessages {
 public:
  /// @param send called with channel, utime and message for each of them.
  template <typename Send>
  void send(const TrackedFrame& frame, Send&& send) {
    namespace channels = messaging::channels;
    const std::int64_t utime = frame.message.utime;
    const Tracked& tracked = frame.tracked;
    if (!session_) session_ = utime;
    if (tracked.T_world_camera) {
      send(channels::kCameraPose, utime,
           messaging::to_rigid_transform(utime, *tracked.T_world_camera));
    }
    // A frame that was only tracked is no key frame, and was not refused as one.
    if (!tracked.registration || tracked.status == TrackStatus::kTracked) return;
    send(channels::kKeyframe, utime,
         to_message(*tracked.registration, frame.message, *session_, sequence_++));
    if (tracked.status != TrackStatus::kKeyframe) return;
    send(channels::kOdomToWorld, utime, messaging::to_rigid_transform(utime, frame.T_world_odom));
  }

  /// @brief Utime of the first frame; nothing before it.
  std::optional<std::int64_t> session() const { return session_; }

 private:
  std::optional<std::int64_t> session_;
  std::int64_t sequence_ = 0;  // of key frames, rejected ones included
};

}  // namespace geomap::perception
