// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "logs/pipeline.hpp"
#include "messaging/convert_frame.hpp"
#include "messaging/log_reader.hpp"

namespace geomap::logs {

/// @brief Feeds the events of a log to the pipeline. Messages are not trusted: what does not decode
/// is counted by channel and reason, and passed over; channels that are no input are ignored.
class LogInput {
 public:
  /// @param cameras of the channels OPENNI_FRAME and KINECT_FRAME, which carry no intrinsics.
  LogInput(Pipeline& pipeline, const messaging::FrameCameras& cameras)
      : pipeline_(pipeline), cameras_(cameras) {}

  void handle(const messaging::LogEvent& event);

  /// @brief Refused messages: channel -> reason -> count.
  using Refused = std::map<std::string, std::map<std::string, std::int64_t>>;
  const Refused& refused() const { return refused_; }
  /// @brief Frames missing by their sequence numbers.
  std::int64_t sequence_gaps() const { return sequence_gaps_; }

 private:
  template <class Message>
  std::optional<Message> decode(const messaging::LogEvent& event);
  template <class Message>
  bool has_sound_time(const messaging::LogEvent& event, const Message& message);
  template <class Message>
  void take_foreign(const messaging::LogEvent& event, const Message& message);
  void refuse(const messaging::LogEvent& event, const std::string& reason);
  void note_sequence(std::int64_t sequence);

  Pipeline& pipeline_;
  messaging::FrameCameras cameras_;
  Refused refused_;
  std::int64_t last_sequence_ = -1;  // negative: none yet
  std::int64_t sequence_gaps_ = 0;
};

}  // namespace geomap::logs
