// SPDX-License-Identifier: BSD-3-Clause
#include "logs/log_survey_text.hpp"

#include <fmt/format.h>

#include <array>
#include <ctime>

#include "logs/table_text.hpp"

namespace geomap::logs {
namespace {

/// "2012-06-26 09:00:00.123 UTC"
std::string time_text(std::int64_t utime) {
  const auto seconds = static_cast<std::time_t>(utime / 1'000'000);
  std::tm utc{};
  std::array<char, 32> text{};
  if (utime < 0 || gmtime_r(&seconds, &utc) == nullptr ||
      std::strftime(text.data(), text.size(), "%F %T", &utc) == 0) {
    return fmt::format("{} us", utime);
  }
  return fmt::format("{}.{:03} UTC", text.data(), utime / 1000 % 1000);
}

std::vector<std::string> row_of(const std::string& name, const ChannelSurvey& channel) {
  const bool has_rate = channel.rate() > 0.0;
  return {printable(name),
          channel.type == nullptr ? "unknown" : channel.type->name,
          fmt::format("{}", channel.events),
          has_rate ? fmt::format("{:.2f}", channel.rate()) : "-",
          size_text(static_cast<double>(channel.bytes) / static_cast<double>(channel.events)),
          size_text(channel.bytes),
          has_rate ? size_text(channel.bandwidth()) + "/s" : "-",
          channel.missing ? fmt::format("{}", *channel.missing) : "-"};
}

std::string verdict(const LogSurvey& survey) {
  const std::string events = count_text(survey.events, "readable event");
  if (survey.is_whole()) return fmt::format("whole: {}\n", events);
  return fmt::format("damaged: {} in {} unreadable, {} no message of its channel's type; {}\n",
                     size_text(survey.damaged_bytes()), count_text(survey.damages.size(), "place"),
                     survey.faulty_events(), events);
}

std::string damages_text(const LogSurvey& survey) {
  std::string text;
  for (const messaging::LogDamage& damage : survey.damages) {
    text += fmt::format("offset {}: {} bytes {}\n", damage.offset, damage.size,
                        damage.at_end ? "of a last event that is cut short" : "unreadable");
  }
  for (const auto& [name, channel] : survey.channels) {
    for (const auto& [reason, events] : channel.faulty) {
      text += fmt::format("offset {}: no {} on {}: {}{}\n", events.first_offset, channel.type->name,
                          printable(name), messaging::to_string(reason),
                          events.count == 1 ? "" : fmt::format(", the first of {}", events.count));
    }
  }
  return text;
}

/// How it was recorded.
std::string remarks_text(const LogSurvey& survey) {
  std::string text;
  for (const auto& [name, channel] : survey.channels) {
    if (channel.missing.value_or(0) == 0) continue;
    text += fmt::format("remark: {} missing on {} by sequence number\n",
                        count_text(static_cast<std::size_t>(*channel.missing), "message"),
                        printable(name));
  }
  if (survey.times_back.count > 0) {
    text += fmt::format(
        "remark: the log's time goes back {}, by at most {:.3f} s, first at offset {}\n",
        count_text(survey.times_back.count, "time"), survey.farthest_back,
        survey.times_back.first_offset);
  }
  return text;
}

}  // namespace

std::string info_text(const LogSurvey& survey) {
  std::vector<std::vector<std::string>> rows = {
      {"channel", "type", "events", "Hz", "mean size", "bytes", "bandwidth", "missing"}};
  for (const auto& [name, channel] : survey.channels) rows.push_back(row_of(name, channel));
  std::string text =
      fmt::format("{}, {:.2f} s, {}\nfrom {}\nto   {}\n\n", count_text(survey.events, "event"),
                  survey.duration(), size_text(survey.file_bytes), time_text(survey.first_utime),
                  time_text(survey.last_utime)) +
      table_text(rows) + "\n" + remarks_text(survey);
  return text + verdict(survey);
}

std::string check_text(const LogSurvey& survey) {
  return damages_text(survey) + remarks_text(survey) + verdict(survey);
}

}  // namespace geomap::logs
