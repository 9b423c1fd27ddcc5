// SPDX-License-Identifier: BSD-3-Clause
#include "logs/message_head.hpp"

#include "messaging/big_endian.hpp"
#include "messaging/safe_decode.hpp"

namespace geomap::logs {

using messaging::MessageSchema;

const MessageSchema* type_of(std::span<const std::uint8_t> message) {
  const auto fingerprint = messaging::fingerprint_of(message);
  return fingerprint ? messaging::known_schemas().find(*fingerprint) : nullptr;
}

const MessageSchema* sound_type_of(std::span<const std::uint8_t> message) {
  const MessageSchema* type = type_of(message);
  if (type == nullptr) return nullptr;
  const auto fault = messaging::check_message(message.data(), message.size(), type->fingerprint);
  return fault == messaging::RejectReason::kNone ? type : nullptr;
}

std::optional<std::int64_t> leading_number(const std::string& name, const MessageSchema& type,
                                           std::span<const std::uint8_t> message) {
  std::size_t offset = messaging::kFingerprintSize;
  for (const messaging::Field& field : type.fields) {
    if (field.type != messaging::FieldType::kInt64 || field.array) break;
    if (field.name == name) return messaging::read_signed(message.data() + offset, 8);
    offset += messaging::encoded_size(field.type);
  }
  return std::nullopt;
}

double seconds_between(std::int64_t first_utime, std::int64_t last_utime) {
  return 1e-6 * (static_cast<double>(last_utime) - static_cast<double>(first_utime));
}

void count_missing(const MessageSchema& type, std::span<const std::uint8_t> message,
                   messaging::SequenceGaps& channel, std::optional<std::int64_t>& missing) {
  const auto session = leading_number("session", type, message);
  const auto sequence = leading_number("sequence", type, message);
  if (!sequence) return;
  missing =
      missing.value_or(0) + (session ? channel.note(*session, *sequence) : channel.note(*sequence));
}

}  // namespace geomap::logs
