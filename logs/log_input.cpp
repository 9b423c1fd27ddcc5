// SPDX-License-Identifier: BSD-3-Clause
#include "logs/log_input.hpp"

#include <utility>

#include "messaging/channels.hpp"
#include "messaging/convert_geometry.hpp"
#include "messaging/safe_decode.hpp"

namespace geomap::logs {

namespace channels = messaging::channels;

template <class Message>
std::optional<Message> LogInput::decode(const messaging::LogEvent& event) {
  auto decoded = messaging::safe_decode<Message>(event.data.data(), event.data.size());
  if (!decoded.message) refuse(event, messaging::to_string(decoded.reason));
  return std::move(decoded.message);
}

void LogInput::refuse(const messaging::LogEvent& event, const std::string& reason) {
  ++refused_[event.channel][reason];
}

// Times before 1970 or beyond what differences of times can hold are no sensor's.
template <class Message>
bool LogInput::has_sound_time(const messaging::LogEvent& event, const Message& message) {
  constexpr std::int64_t kLatest = std::int64_t{1} << 61;
  if (message.utime >= 0 && message.utime < kLatest) return true;
  refuse(event, "bad_utime");
  return false;
}

void LogInput::handle(const messaging::LogEvent& event) {
  if (event.channel == channels::kRgbdFrame) {
    const auto frame = decode<geomap::rgbd_frame_t>(event);
    if (frame && has_sound_time(event, *frame)) {
      note_sequence(frame->sequence);
      pipeline_.add_frame(*frame);
    }
  } else if (event.channel == channels::kOpenniFrame) {
    if (const auto images = decode<bot_core::images_t>(event)) take_foreign(event, *images);
  } else if (event.channel == channels::kKinectFrame) {
    if (const auto frame = decode<kinect::frame_msg_t>(event)) take_foreign(event, *frame);
  } else if (event.channel == channels::kPose) {
    const auto pose = decode<bot_core::pose_t>(event);
    if (pose && has_sound_time(event, *pose)) {
      pipeline_.add_pose(pose->utime, messaging::from_message(*pose));
    }
  } else if (event.channel == channels::kCameraToBody) {
    const auto neck = decode<bot_core::rigid_transform_t>(event);
    if (neck && has_sound_time(event, *neck)) {
      pipeline_.add_camera_to_body(neck->utime, messaging::from_message(*neck));
    }
  }
}

// What other LCM camera drivers publish, without intrinsics: as a frame of our own from here on.
template <class Message>
void LogInput::take_foreign(const messaging::LogEvent& event, const Message& message) {
  messaging::FrameResult converted = messaging::to_frame(message, cameras_);
  if (!converted.frame) {
    refuse(event, messaging::to_string(converted.fault));
    return;
  }
  geomap::rgbd_frame_t frame = messaging::to_message(*converted.frame);
  if (has_sound_time(event, frame)) pipeline_.add_frame(std::move(frame));
}

void LogInput::note_sequence(std::int64_t sequence) {
  constexpr std::int64_t kRestart = 1'000'000;  // a longer jump is another driver, not a loss
  if (last_sequence_ >= 0 && sequence > last_sequence_ && sequence - last_sequence_ < kRestart) {
    sequence_gaps_ += sequence - last_sequence_ - 1;
  }
  last_sequence_ = sequence;
}

}  // namespace geomap::logs
