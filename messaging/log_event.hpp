// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace geomap::messaging {

/// @brief One event of an LCM log.
struct LogEvent {
  std::int64_t number = 0;  // as the log counts
  std::int64_t log_utime =
      0;  // when the logger received it [us]; not monotonic, not the sensor's time
  std::string channel;
  std::vector<std::uint8_t> data;
};

/// @brief In a file an event is a magic word, number, time stamp, length of the channel name,
/// length of the data (big-endian, 4, 8, 8, 4 and 4 bytes), the channel name and the data.
inline constexpr std::array<std::uint8_t, 4> kLogMagic = {0xED, 0xA1, 0xDA, 0x01};
inline constexpr std::size_t kLogHeaderSize = 28;

/// @brief What stands in a file before the event's channel name.
std::array<std::uint8_t, kLogHeaderSize> log_header(const LogEvent& event);

/// @brief How many bytes of a file the event takes.
std::int64_t size_in_log(const LogEvent& event);

}  // namespace geomap::messaging
