// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace geomap::messaging {

/// @brief Whole number of 1 to 8 bytes, most significant first, as LCM writes messages and logs.
inline std::uint64_t read_unsigned(const std::uint8_t* bytes, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) value = (value << 8) | bytes[i];
  return value;
}

/// @brief The same with a sign.
inline std::int64_t read_signed(const std::uint8_t* bytes, std::size_t size) {
  const auto unused_bits = static_cast<int>(64 - 8 * size);
  return static_cast<std::int64_t>(read_unsigned(bytes, size) << unused_bits) >> unused_bits;
}

inline double read_double(const std::uint8_t* bytes) {
  return std::bit_cast<double>(read_unsigned(bytes, 8));
}

inline float read_float(const std::uint8_t* bytes) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(read_unsigned(bytes, 4)));
}

/// @brief The inverse of read_unsigned(): the lowest `size` bytes of a number.
inline void write_unsigned(std::uint64_t value, std::uint8_t* bytes, std::size_t size) {
  for (std::size_t i = size; i-- > 0; value >>= 8) bytes[i] = static_cast<std::uint8_t>(value);
}

}  // namespace geomap::messaging
