// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "messaging/convert_frame.hpp"
#include "messaging/sequence_gaps.hpp"
#include "perception/tracking_process.hpp"

namespace geomap::perception {

/// @brief Feeds what sensors and robot publish to registration. Messages are not trusted: what does
/// not decode is counted by channel and reason, and passed over; channels that are no input are
/// ignored.
class SensorMessages {
 public:
  using Bytes = std::span<const std::uint8_t>;

  /// @param cameras of the channels OPENNI_FRAME and KINECT_FRAME, which carry no intrinsics.
  /// @param correction that every frame's depth gets first of all.
  SensorMessages(TrackingProcess& tracking, const messaging::FrameCameras& cameras,
                 const geometry::DepthCorrection& correction = {})
      : tracking_(tracking), cameras_(cameras), correction_(correction) {}

  void handle(const std::string& channel, Bytes data);

  /// @brief Refused messages: channel -> reason -> count.
  using Refused = std::map<std::string, std::map<std::string, std::int64_t>>;
  const Refused& refused() const { return refused_; }
  /// @brief Frames missing by their sequence numbers.
  std::int64_t missing_frames() const { return missing_frames_; }

 private:
  template <class Message>
  std::optional<Message> decode(const std::string& channel, Bytes data);
  template <class Message>
  bool has_sound_time(const std::string& channel, const Message& message);
  template <class Message>
  void take_foreign(const std::string& channel, Bytes data);
  void refuse(const std::string& channel, const std::string& reason);
  void add_frame(geomap::rgbd_frame_t frame);

  TrackingProcess& tracking_;
  messaging::FrameCameras cameras_;
  geometry::DepthCorrection correction_;
  Refused refused_;
  messaging::SequenceGaps sequence_;
  std::int64_t missing_frames_ = 0;
};

}  // namespace geomap::perception
