// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace geomap::messaging {

/// @brief Whole number of 1 to 8 bytes, most significant first, as LCM writes messages and logs.
inline std::uint64_t read_unsigned(const std::uint8_t* bytes, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) value = (value << 8) | bytes[i];
  return value;
}

}  // namespace geomap::messaging
