// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/channel_counts.hpp"

#include <algorithm>

namespace geomap::viewer {
namespace {

using namespace std::chrono_literals;

constexpr auto kWindow = 5s;
constexpr auto kLeastSpan = 1s;
constexpr std::size_t kMostArrivals = 2000;  // that are remembered
constexpr auto kTroubleWindow = 1min;
constexpr std::size_t kMostTroubles = 3000;  // more than there are updates in a minute

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

// The numbers in all as they were a minute ago are those of the newest entry from before; what was
// reported as missing and came after all may make them fall.
void update_troubles(Clock::time_point now, ChannelState& channel) {
  auto& troubles = channel.troubles;
  const ChannelState::Trouble newest = troubles.empty() ? ChannelState::Trouble{} : troubles.back();
  const bool is_grown = newest.missing != channel.missing || newest.refused != channel.refused;
  if (troubles.empty()) troubles.push_back({});
  if (is_grown) troubles.push_back({now, channel.missing, channel.refused});
  while (troubles.size() > 1 && now - troubles[1].at > kTroubleWindow) troubles.pop_front();
  while (troubles.size() > kMostTroubles) troubles.pop_front();
  channel.recent_missing = std::max<std::int64_t>(0, channel.missing - troubles.front().missing);
  channel.recent_refused = channel.refused - troubles.front().refused;
}

}  // namespace geomap::viewer
