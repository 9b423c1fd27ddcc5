// SPDX-License-Identifier: BSD-3-Clause
#include "logs/log_survey.hpp"

#include <algorithm>
#include <optional>

#include "logs/log_pass.hpp"
#include "messaging/big_endian.hpp"

namespace geomap::logs {
namespace {

using messaging::Field;
using messaging::FieldType;
using messaging::LogEvent;
using messaging::MessageSchema;
using messaging::RejectReason;

constexpr std::size_t kFingerprintSize = 8;

std::int64_t read_int64(const std::uint8_t* bytes) {
  return static_cast<std::int64_t>(messaging::read_unsigned(bytes, 8));
}

/// In floating point, where no damaged time overflows.
double seconds_between(std::int64_t first_utime, std::int64_t last_utime) {
  return 1e-6 * (static_cast<double>(last_utime) - static_cast<double>(first_utime));
}

const MessageSchema* type_of(const LogEvent& event) {
  if (event.data.size() < kFingerprintSize) return nullptr;
  return messaging::known_schemas().find(read_int64(event.data.data()));
}

/// The sequence number of a sound message whose type has one among the plain numbers at its head.
std::optional<std::int64_t> sequence_of(const MessageSchema& type, const LogEvent& event) {
  std::size_t offset = kFingerprintSize;
  for (const Field& field : type.fields) {
    if (field.type != FieldType::kInt64 || field.array) break;
    if (field.name == "sequence") return read_int64(event.data.data() + offset);
    offset += messaging::encoded_size(field.type);
  }
  return std::nullopt;
}

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

  const MessageSchema* type = type_of(event);
  if (channel.type == nullptr) channel.type = type;
  const RejectReason reason = check(channel.type, type, event);
  if (reason != RejectReason::kNone) {
    count(channel.faulty[reason], offset);
  } else if (const auto sequence = sequence_of(*type, event)) {
    if (!channel.sequence) channel.sequence.emplace();
    channel.sequence->note(*sequence);
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
