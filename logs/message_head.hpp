// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "messaging/message_schema.hpp"
#include "messaging/sequence_gaps.hpp"

namespace geomap::logs {

/// @brief The type of an encoded message by its fingerprint; nullptr when it is none of ours.
const messaging::MessageSchema* type_of(std::span<const std::uint8_t> message);

/// @brief The same when the message is sound: it can be decoded; else nullptr.
const messaging::MessageSchema* sound_type_of(std::span<const std::uint8_t> message);

/// @brief One of the plain numbers that a sound message begins with, for example its utime; nothing
/// when its type does not have it there.
std::optional<std::int64_t> leading_number(const std::string& name,
                                           const messaging::MessageSchema& type,
                                           std::span<const std::uint8_t> message);

/// @brief In floating point, where no damaged time overflows [s].
double seconds_between(std::int64_t first_utime, std::int64_t last_utime);

/// @brief Adds to `missing` the messages of a channel that are missing before this sound one;
/// leaves it alone when the type has no sequence numbers.
void count_missing(const messaging::MessageSchema& type, std::span<const std::uint8_t> message,
                   messaging::SequenceGaps& channel, std::optional<std::int64_t>& missing);

}  // namespace geomap::logs
