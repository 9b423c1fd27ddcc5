// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "messaging/log_reader.hpp"
#include "messaging/message_schema.hpp"
#include "messaging/safe_decode.hpp"
#include "messaging/sequence_gaps.hpp"

namespace geomap::logs {

/// @brief Some events with the same fault.
struct FaultyEvents {
  std::size_t count = 0;
  std::int64_t first_offset = 0;  // of the first one in the file [byte]
};

/// @brief What a log holds on one channel.
struct ChannelSurvey {
  /// Of the first event with a known fingerprint; nullptr while there was none. It is the type that
  /// the channel carries.
  const messaging::MessageSchema* type = nullptr;
  std::size_t events = 0;
  std::int64_t bytes = 0;        // of the messages
  std::int64_t first_utime = 0;  // log's time [us]
  std::int64_t last_utime = 0;   // log's time [us]
  messaging::SequenceGaps sequence;
  std::optional<std::int64_t> missing;  // by sequence numbers, where messages have them
  /// Events that are no message of the channel's type, where it has one.
  std::map<messaging::RejectReason, FaultyEvents> faulty;

  /// @brief Events a second from the first to the last one; 0 where that says nothing.
  double rate() const;
  /// @brief Bytes of messages a second, likewise.
  double bandwidth() const;
};

/// @brief What is in a log, and what is wrong with it.
struct LogSurvey {
  std::size_t events = 0;
  std::int64_t file_bytes = 0;
  std::int64_t first_utime = 0;  // log's time of the first event [us]
  std::int64_t last_utime = 0;   // of the last one [us]
  std::map<std::string, ChannelSurvey> channels;
  std::vector<messaging::LogDamage> damages;

  FaultyEvents times_back;     // events with an earlier time than the one before
  double farthest_back = 0.0;  // [s]

  /// @brief From the first event to the last one [s].
  double duration() const;
  /// @brief Bytes that hold no readable event.
  std::int64_t damaged_bytes() const;
  /// @brief Events that are no message of the type that their channel carries.
  std::size_t faulty_events() const;
  /// @brief Every byte is a readable event, and every message one of its channel's type. Gaps in
  /// sequence numbers and times that go back are how it was recorded, not damage.
  bool is_whole() const { return damages.empty() && faulty_events() == 0; }
};

/// @brief Reads a whole log. Messages of known types are checked field by field; what a channel
/// without any known type carries, like LCM_SELF_TEST, is somebody else's.
/// @throws std::runtime_error, one line, when it is no log, or on Ctrl-C.
LogSurvey survey_log(const std::string& path);

}  // namespace geomap::logs
