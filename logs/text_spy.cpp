// SPDX-License-Identifier: BSD-3-Clause
#include "logs/text_spy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "logs/channel_regex.hpp"
#include "logs/message_fields.hpp"
#include "logs/table_text.hpp"
#include "logs/terminal.hpp"
#include "logs/traffic_text.hpp"
#include "messaging/bus.hpp"
#include "messaging/config.hpp"
#include "messaging/host_clock.hpp"

namespace geomap::logs {
namespace {

using Clock = messaging::Inbox::Clock;

constexpr double kPeriod = 1.0;            // between two tables [s]
constexpr double kWindow = 10.0;           // of rates [s]: a snapshot every 5 s is seen twice
constexpr double kLongestOnce = 86'400.0;  // [s]
constexpr double kSpoolMb = 64.0;

// "CHANNEL" or "CHANNEL.FIELD", where a channel's name may hold dots itself.
bool concerns(const std::string& wanted, const std::string& channel) {
  return wanted == channel || wanted.starts_with(channel + ".");
}

void listen(messaging::Bus& bus, TextSpy& spy, double seconds) {
  const auto end = Clock::now() + messaging::Inbox::duration(seconds);
  constexpr std::chrono::milliseconds kPoll{100};  // until it looks whether it shall end
  for (auto now = Clock::now(); now < end && !messaging::stop_requested(); now = Clock::now()) {
    if (const auto message = bus.take(std::min(end, now + kPoll))) {
      spy.take(*message, messaging::host_microseconds());
    }
  }
}

std::string dropped_text(std::int64_t messages) {
  if (messages == 0) return {};
  return fmt::format("\n{} messages came too fast to be counted\n", messages);
}

}  // namespace

TextSpy::TextSpy(const TextSpyOptions& options)
    : channels_(channel_regex("--channel", options.channels)),
      fields_(options.fields),
      traffic_(options.once.value_or(kWindow)) {
  if (options.once && !(*options.once > 0.0 && *options.once <= kLongestOnce)) {
    throw messaging::ConfigError("--once: more than 0 and at most 86400 seconds");
  }
}

void TextSpy::take(const messaging::Received& message, std::int64_t utime) {
  if (!std::regex_match(message.channel, channels_)) return;
  traffic_.add(message.channel, message.data, utime);
  for (const std::string& wanted : fields_) {
    if (concerns(wanted, message.channel)) newest_[wanted] = message;
  }
}

std::string TextSpy::text(std::int64_t utime) const {
  std::string text = has_heard() ? traffic_text(traffic_, utime)
                                 : "nothing has come yet; see also geomap-doctor\n";
  for (const std::string& wanted : fields_) text += '\n' + fields_text(wanted);
  return text;
}

std::string TextSpy::fields_text(const std::string& wanted) const {
  const auto newest = newest_.find(wanted);
  if (newest == newest_.end()) return wanted + ": nothing has come on this channel\n";
  const auto& [channel, data] = newest->second;
  const auto fields =
      message_fields(data, wanted == channel ? "" : wanted.substr(channel.size() + 1));
  if (fields.empty()) return wanted + ": no such field, or a message that cannot be decoded\n";
  std::string text = printable(channel) + "\n";
  for (const FieldText& field : fields) text += fmt::format("  {}: {}\n", field.path, field.value);
  return text;
}

int run_text_spy(const TextSpyOptions& options, const messaging::CommonOptions& common) {
  TextSpy spy(options);
  messaging::Bus bus({common.lcm_url, common.channel_prefix, false, kSpoolMb});
  bus.subscribe_all();
  bus.start();
  do {
    listen(bus, spy, options.once.value_or(kPeriod));
    if (options.once && !spy.has_heard()) {
      throw std::runtime_error("nothing was heard: geomap-doctor finds out why");
    }
    show(spy.text(messaging::host_microseconds()) + dropped_text(bus.inbox().overflowed()));
  } while (!options.once && !messaging::stop_requested());
  return 0;
}

}  // namespace geomap::logs
