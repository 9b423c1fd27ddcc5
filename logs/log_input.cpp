// SPDX-License-Identifier: BSD-3-Clause
#include "logs/log_input.hpp"

#include <stdexcept>
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

void LogInput::handle(const messaging::LogEvent& event) {
  try {
    if (event.channel == channels::kRgbdFrame) {
      if (auto frame = decode<geomap::rgbd_frame_t>(event)) {
        note_sequence(frame->sequence);
        pipeline_.add_frame(std::move(*frame));
      }
    } else if (event.channel == channels::kPose) {
      if (const auto pose = decode<bot_core::pose_t>(event)) {
        pipeline_.add_pose(pose->utime, messaging::from_message(*pose));
      }
    } else if (event.channel == channels::kCameraToBody) {
      if (const auto neck = decode<bot_core::rigid_transform_t>(event)) {
        pipeline_.add_camera_to_body(neck->utime, messaging::from_message(*neck));
      }
    }
  } catch (const std::invalid_argument&) {  // numbers that decode, but mean nothing
    refuse(event, "invalid");
  }
}

void LogInput::note_sequence(std::int64_t sequence) {
  constexpr std::int64_t kRestart = 1'000'000;  // a longer jump is another driver, not a loss
  if (last_sequence_ >= 0 && sequence > last_sequence_ && sequence - last_sequence_ < kRestart) {
    sequence_gaps_ += sequence - last_sequence_ - 1;
  }
  last_sequence_ = sequence;
}

}  // namespace geomap::logs
