// SPDX-License-Identifier: BSD-3-Clause
#include "perception/sensor_messages.hpp"

#include <utility>

#include "messaging/channels.hpp"
#include "messaging/convert_geometry.hpp"
#include "messaging/safe_decode.hpp"

namespace geomap::perception {

namespace channels = messaging::channels;

template <class Message>
std::optional<Message> SensorMessages::decode(const std::string& channel, Bytes data) {
  auto decoded = messaging::safe_decode<Message>(data.data(), data.size());
  if (!decoded.message) refuse(channel, messaging::to_string(decoded.reason));
  return std::move(decoded.message);
}

void SensorMessages::refuse(const std::string& channel, const std::string& reason) {
  ++refused_[channel][reason];
}

// Times before 1970 or beyond what differences of times can hold are no sensor's.
template <class Message>
bool SensorMessages::has_sound_time(const std::string& channel, const Message& message) {
  constexpr std::int64_t kLatest = std::int64_t{1} << 61;
  if (message.utime >= 0 && message.utime < kLatest) return true;
  refuse(channel, "bad_utime");
  return false;
}

void SensorMessages::handle(const std::string& channel, Bytes data) {
  if (channel == channels::kRgbdFrame) {
    auto frame = decode<geomap::rgbd_frame_t>(channel, data);
    if (frame && has_sound_time(channel, *frame)) {
      missing_frames_ += sequence_.note(frame->sequence);
      add_frame(std::move(*frame));
    }
  } else if (channel == channels::kOpenniFrame) {
    take_foreign<bot_core::images_t>(channel, data);
  } else if (channel == channels::kKinectFrame) {
    take_foreign<kinect::frame_msg_t>(channel, data);
  } else if (channel == channels::kPose) {
    const auto pose = decode<bot_core::pose_t>(channel, data);
    if (pose && has_sound_time(channel, *pose)) {
      tracking_.add_pose(pose->utime, messaging::from_message(*pose));
    }
  } else if (channel == channels::kCameraToBody) {
    const auto neck = decode<bot_core::rigid_transform_t>(channel, data);
    if (neck && has_sound_time(channel, *neck)) {
      tracking_.add_camera_to_body(neck->utime, messaging::from_message(*neck));
    }
  }
}

// What other LCM camera drivers publish, without intrinsics: as a frame of our own from here on.
template <class Message>
void SensorMessages::take_foreign(const std::string& channel, Bytes data) {
  const auto message = decode<Message>(channel, data);
  if (!message) return;
  messaging::FrameMessageResult own = messaging::to_own_message(*message, cameras_);
  if (!own.message) {
    refuse(channel, messaging::to_string(own.fault));
    return;
  }
  if (has_sound_time(channel, *own.message)) add_frame(std::move(*own.message));
}

// A frame that cannot be decoded is refused later, as any other.
void SensorMessages::add_frame(geomap::rgbd_frame_t frame) {
  if (!correction_.is_none()) messaging::correct_depth(frame, correction_);
  tracking_.add_frame(std::move(frame));
}

}  // namespace geomap::perception
