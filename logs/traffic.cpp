// SPDX-License-Identifier: BSD-3-Clause
#include "logs/traffic.hpp"

#include <cmath>

#include "logs/message_head.hpp"

namespace geomap::logs {
namespace {

constexpr double kLongestLatency = 60.0;  // [s]

// Kinect messages call it timestamp.
std::optional<double> latency_of(const messaging::MessageSchema& type,
                                 std::span<const std::uint8_t> message, std::int64_t utime) {
  auto measured = leading_number("utime", type, message);
  if (!measured) measured = leading_number("timestamp", type, message);
  if (!measured) return std::nullopt;
  const double latency = seconds_between(*measured, utime);
  return std::abs(latency) <= kLongestLatency ? std::optional(latency) : std::nullopt;
}

}  // namespace

void Traffic::add(const std::string& name, std::span<const std::uint8_t> message,
                  std::int64_t utime) {
  if (channels_.size() >= kMostChannels && !channels_.contains(name)) {
    ++left_out_;
    return;
  }
  ChannelTraffic& channel = channels_.try_emplace(name, window_).first->second;
  ++channel.messages;
  if (const auto* type = type_of(message)) channel.type = type;
  std::optional<double> latency;
  if (const auto* type = sound_type_of(message)) {
    count_missing(*type, message, channel.sequence, channel.missing);
    latency = latency_of(*type, message, utime);
  } else {
    ++channel.undecodable;
  }
  channel.window.add(utime, message.size(), latency);
}

}  // namespace geomap::logs
