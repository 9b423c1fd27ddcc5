// SPDX-License-Identifier: BSD-3-Clause
#include "logs/log_survey.hpp"

#include <algorithm>

#include "logs/log_pass.hpp"
#include "logs/message_head.hpp"

namespace geomap::logs {
namespace {

using messaging::kFingerprintSize;
using messaging::LogEvent;
using messaging::MessageSchema;
using messaging::RejectReason;

void count(FaultyEvents& events, std::int64_t offset) {
  if (events.count++ == 0) events.first_offset = offset;
}

RejectReason check(const MessageSchema* channel_type, const MessageSchema* type,
                   const LogEvent& event) {
  if (event.data.size() < kFingerprintSize) return RejectReason::kTooShort;
  if (type == nullptr || type != channel_type) return RejectReason::kWrongType;
  return messaging::check_message(event.data.data(), event.data.size(), type->fingerprint);
}

void add(ChannelSurvey& channel, const LogEvent& event, std::int64_t offset) {
  if (channel.events++ == 0) channel.first_utime = event.log_utime;
  channel.last_utime = event.log_utime;
  channel.bytes += static_cast<std::int64_t>(event.data.size());

  const MessageSchema* type = type_of(event.data);
  if (channel.type == nullptr) channel.type = type;
  const RejectReason reason = check(channel.type, type, event);
  if (reason != RejectReason::kNone) {
    count(channel.faulty[reason], offset);
  } else {
    count_missing(*channel.type, event.data, channel.sequence, channel.missing);
  }
}

void add(LogSurvey& survey, const LogEvent& event, std::int64_t offset) {
  if (survey.events++ == 0) {
    survey.first_utime = event.log_utime;
  } else if (event.log_utime < survey.last_utime) {
    count(survey.times_back, offset);
    survey.farthest_back =
        std::max(survey.farthest_back, seconds_between(event.log_utime, survey.last_utime));
  }
  survey.last_utime = event.log_utime;
  add(survey.channels[event.channel], event, offset);
}

}  // namespace

double ChannelSurvey::rate() const {
  const double seconds = seconds_between(first_utime, last_utime);
  return seconds > 0.0 ? static_cast<double>(events - 1) / seconds : 0.0;
}

double ChannelSurvey::bandwidth() const {
  return rate() * static_cast<double>(bytes) / static_cast<double>(events);
}

double LogSurvey::duration() const { return seconds_between(first_utime, last_utime); }

std::int64_t LogSurvey::damaged_bytes() const {
  std::int64_t sum = 0;
  for (const messaging::LogDamage& damage : damages) sum += damage.size;
  return sum;
}

std::size_t LogSurvey::faulty_events() const {
  std::size_t sum = 0;
  for (const auto& [name, channel] : channels) {
    for (const auto& [reason, alike] : channel.faulty) sum += alike.count;
  }
  return sum;
}

LogSurvey survey_log(const std::string& path) {
  messaging::LogReader reader(path);
  LogSurvey survey;
  read_events(reader, [&](const LogEvent& event) {
    add(survey, event, reader.position() - messaging::size_in_log(event));
  });
  survey.file_bytes = reader.size();
  survey.damages = reader.damages();
  for (auto& [name, channel] : survey.channels) {
    if (channel.type == nullptr) channel.faulty.clear();
  }
  return survey;
}

}  // namespace geomap::logs
