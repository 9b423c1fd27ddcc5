// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/log_event.hpp"

#include <algorithm>

#include "messaging/big_endian.hpp"

namespace geomap::messaging {

std::array<std::uint8_t, kLogHeaderSize> log_header(const LogEvent& event) {
  std::array<std::uint8_t, kLogHeaderSize> bytes{};
  std::copy(kLogMagic.begin(), kLogMagic.end(), bytes.begin());
  write_unsigned(static_cast<std::uint64_t>(event.number), bytes.data() + 4, 8);
  write_unsigned(static_cast<std::uint64_t>(event.log_utime), bytes.data() + 12, 8);
  write_unsigned(event.channel.size(), bytes.data() + 20, 4);
  write_unsigned(event.data.size(), bytes.data() + 24, 4);
  return bytes;
}

std::int64_t size_in_log(const LogEvent& event) {
  return static_cast<std::int64_t>(kLogHeaderSize + event.channel.size() + event.data.size());
}

}  // namespace geomap::messaging
