// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/channel_counts.hpp"

namespace geomap::viewer {
namespace {

using namespace std::chrono_literals;

constexpr auto kWindow = 5s;
constexpr auto kLeastSpan = 1s;
constexpr std::size_t kMostArrivals = 2000;  // that are remembered

}  // namespace

void note_arrival(std::size_t bytes, Clock::time_point now, ChannelState& channel) {
  ++channel.messages;
  channel.bytes += static_cast<std::int64_t>(bytes);
  channel.last = now;
  channel.recent.push_back(now);
  if (channel.recent.size() > kMostArrivals) channel.recent.pop_front();
}

void update_rate(Clock::time_point now, ChannelState& channel) {
  auto& recent = channel.recent;
  while (!recent.empty() && now - recent.front() > kWindow) recent.pop_front();
  channel.rate = 0.0;
  if (recent.empty()) return;
  const std::chrono::duration<double> span = now - recent.front();
  if (span >= kLeastSpan) channel.rate = static_cast<double>(recent.size() - 1) / span.count();
}

}  // namespace geomap::viewer
