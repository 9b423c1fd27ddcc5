// SPDX-License-Identifier: BSD-3-Clause
#include "logs/traffic_text.hpp"

#include <fmt/format.h>

#include "logs/table_text.hpp"

namespace geomap::logs {
namespace {

std::string milliseconds_text(std::optional<double> seconds) {
  return seconds ? fmt::format("{:.1f} ms", 1e3 * *seconds) : "-";
}

std::vector<std::string> row_of(const std::string& name, const ChannelTraffic& channel,
                                const TrafficRates& rates) {
  const bool has_rate = rates.hertz > 0.0;
  return {printable(name),
          channel.type == nullptr ? "unknown" : channel.type->name,
          fmt::format("{}", channel.messages),
          has_rate ? fmt::format("{:.2f}", rates.hertz) : "-",
          has_rate ? size_text(rates.bandwidth) + "/s" : "-",
          channel.missing ? fmt::format("{}", *channel.missing) : "-",
          milliseconds_text(rates.mean_latency),
          milliseconds_text(rates.longest_latency),
          fmt::format("{}", channel.undecodable)};
}

}  // namespace

std::string traffic_text(const Traffic& traffic, std::int64_t utime) {
  std::vector<std::vector<std::string>> rows = {{"channel", "type", "messages", "Hz", "bandwidth",
                                                 "missing", "latency", "longest", "undecodable"}};
  double hertz = 0.0, bandwidth = 0.0;
  for (const auto& [name, channel] : traffic.channels()) {
    const TrafficRates rates = channel.window.rates(utime);
    rows.push_back(row_of(name, channel, rates));
    hertz += rates.hertz;
    bandwidth += rates.bandwidth;
  }
  std::string text = fmt::format("{}, {:.1f} messages/s, {}/s\n\n{}",
                                 count_text(traffic.channels().size(), "channel"), hertz,
                                 size_text(bandwidth), table_text(rows));
  if (traffic.left_out() > 0) {
    text += fmt::format("{} messages on further channels are left out\n", traffic.left_out());
  }
  return text;
}

}  // namespace geomap::logs
