// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "logs/traffic_window.hpp"
#include "messaging/message_schema.hpp"
#include "messaging/sequence_gaps.hpp"

namespace geomap::logs {

/// @brief What came on one channel.
struct ChannelTraffic {
  explicit ChannelTraffic(double window_seconds) : window(window_seconds) {}

  const messaging::MessageSchema* type = nullptr;  // of the newest message whose type is known
  std::int64_t messages = 0;
  std::int64_t undecodable = 0;  // of no known type, or damaged
  messaging::SequenceGaps sequence;
  std::optional<std::int64_t> missing;  // by sequence numbers, where messages have them
  TrafficWindow window;
};

/// @brief Counts what comes on a bus, whatever that may be. Does not know LCM or the clock.
class Traffic {
 public:
  /// @param window over which rates and latencies are taken [s]
  explicit Traffic(double window) : window_(window) {}

  /// @param utime when it came, host's clock [us]. A latency is the time since the message's own
  /// utime where that is a minute at most: a log that is played has old times.
  void add(const std::string& channel, std::span<const std::uint8_t> message, std::int64_t utime);

  /// @brief By name. A sender that invents names cannot make it grow without bounds.
  const std::map<std::string, ChannelTraffic>& channels() const { return channels_; }
  /// @brief Messages on channels for which there is no room.
  std::int64_t left_out() const { return left_out_; }

 private:
  static constexpr std::size_t kMostChannels = 1000;

  double window_;
  std::map<std::string, ChannelTraffic> channels_;
  std::int64_t left_out_ = 0;
};

}  // namespace geomap::logs
