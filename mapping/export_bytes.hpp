// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <bit>
#include <cstdint>
#include <string>

namespace geomap::mapping {

/// @brief Appends numbers to a binary file's content, little-endian on every machine.
inline void append_uint32(std::string& bytes, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) {
    bytes += static_cast<char>(static_cast<unsigned char>((value >> shift) & 0xFFU));
  }
}

inline void append_float(std::string& bytes, float value) {
  append_uint32(bytes, std::bit_cast<std::uint32_t>(value));
}

inline void append_floats(std::string& bytes, const Eigen::Vector3f& values) {
  for (const float value : values) append_float(bytes, value);
}

}  // namespace geomap::mapping
