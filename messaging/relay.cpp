// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/relay.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <exception>
#include <map>
#include <optional>

#include "messaging/config.hpp"
#include "messaging/log.hpp"

namespace geomap::messaging {
namespace {

using Clock = Inbox::Clock;
using namespace std::chrono_literals;

constexpr std::size_t kLargest = 16'384;  // of a message [byte]
constexpr std::size_t kHeaders = 28 + 8;  // of IP, UDP and LCM [byte]
constexpr auto kLook = 50ms;              // until the thread looks whether it shall end
constexpr auto kRetry = 1s;               // of opening a bus
constexpr auto kLastWords = 1s;           // what may still be carried at the end
constexpr double kSpool = 3.0;            // messages that wait, as time on the link [s]
constexpr double kLeastSpool = 0.1;       // a large map, whole [MB]
constexpr double kBytesPerKbit = 1000.0 / 8;

}  // namespace

Relay::Relay(const RelayConfig& config) : config_(config) {
  if (is_same_bus(config.from.url, config.to.url)) {
    throw ConfigError("cannot relay from " + config.from.url + " to " + config.to.url +
                      ": they are one bus; give one of them another port");
  }
  config_.from.spool_mb = std::max(kLeastSpool, 1e-6 * kSpool * config.kbit_per_s * kBytesPerKbit);
  thread_ = std::thread([this] { run(); });
}

Relay::~Relay() {
  is_stopping_ = true;
  thread_.join();
}

void Relay::run() {
  bool has_complained = false;
  while (!is_stopping_) {
    try {
      Bus from(config_.from), to(config_.to);
      for (const RelayedChannel& channel : config_.channels) {
        from.subscribe(channel.name, channel.keep);
      }
      from.start();
      carry(from, to);
    } catch (const std::exception& error) {
      if (!has_complained) log_warning(error.what() + std::string("; trying again"));
      has_complained = true;
      std::this_thread::sleep_for(kRetry);
    }
  }
}

void Relay::carry(Bus& from, Bus& to) {
  std::map<std::string, Clock::duration> periods;
  for (const RelayedChannel& channel : config_.channels) {
    periods[channel.name] = Inbox::duration(channel.period);
  }
  std::map<std::string, Clock::time_point> due;
  std::int64_t too_large = 0;
  std::optional<Clock::time_point> end;
  while (!end || Clock::now() < *end) {
    const auto message = from.take(Clock::now() + kLook);
    if (is_stopping_ && !end) end = Clock::now() + kLastWords;
    dropped_ = from.inbox().overflowed() + to.unsent() + too_large;
    if (!message) {
      if (end) return;
      continue;
    }
    const Clock::time_point now = Clock::now();
    if (now < due[message->channel]) continue;
    due[message->channel] = now + periods.at(message->channel);
    if (message->data.size() > kLargest) {
      ++too_large;
      continue;
    }
    to.publish_bytes(message->channel, message->data);
    const std::size_t bytes = message->data.size() + message->channel.size() + kHeaders;
    ++sent_;
    sent_bytes_ += static_cast<std::int64_t>(bytes);
    std::this_thread::sleep_until(
        now + Inbox::duration(static_cast<double>(bytes) / (kBytesPerKbit * config_.kbit_per_s)));
  }
}

}  // namespace geomap::messaging
