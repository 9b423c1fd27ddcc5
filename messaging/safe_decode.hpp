// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <utility>

namespace geomap::messaging {

/// @brief Why bytes from the bus or a file were refused. Counted in HEALTH under `to_string`.
enum class RejectReason {
  kNone,
  kTooShort,    // not even a fingerprint
  kWrongType,   // the fingerprint of another type, or of another version of this one
  kTooLarge,    // beyond what this type may need
  kBadCount,    // a count is negative, or larger than any message of this type could hold
  kTruncated,   // ends early
  kTrailing,    // goes on behind the last field
  kBadString,   // a string without its terminating zero
  kNotFinite,   // a NaN or an infinity
  kNotUnit,     // a quaternion or direction is not of unit length, or a rotation not orthonormal
  kUndecodable  // the generated decoder refused it all the same
};

/// @brief Short name for counters and log lines, for example "bad_count".
std::string to_string(RejectReason reason);

/// @brief Checks an encoded message against its layout without decoding it: every count, size,
/// string and number. Allocates nothing. Costs microseconds: byte arrays are stepped over.
/// @param fingerprint of the expected type, `M::getHash()`.
/// @throws std::logic_error when the type is not one of lcmtypes/.
RejectReason check_message(const void* data, std::size_t size, std::int64_t fingerprint);

/// @brief A message, or the reason why there is none.
template <class Message>
struct DecodeResult {
  std::optional<Message> message;
  RejectReason reason = RejectReason::kNone;
};

/// @brief Decodes bytes that nobody vouches for. LCM's generated decoder alone throws at a count of
/// -1 and allocates gigabytes at a count of 2³¹ - 1; here counts and sizes are checked first, so
/// that the memory used is in proportion to `size`. Never throws on account of the data.
template <class Message>
DecodeResult<Message> safe_decode(const void* data, std::size_t size) {
  const RejectReason reason = check_message(data, size, Message::getHash());
  if (reason != RejectReason::kNone) return {std::nullopt, reason};
  try {
    Message message{};
    const int length = static_cast<int>(size);
    if (message.decode(data, 0, length) == length) return {std::move(message), RejectReason::kNone};
  } catch (const std::exception&) {
    // Out of memory, or a layout the check does not know: refused like any other bad message.
  }
  return {std::nullopt, RejectReason::kUndecodable};
}

}  // namespace geomap::messaging
