// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>

namespace geomap::messaging {

/// @brief The host's clock [us since 1970]; for people and for telling processes apart, never for
/// decisions.
inline std::int64_t host_microseconds() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace geomap::messaging
