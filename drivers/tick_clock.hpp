// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

namespace geomap::drivers {

inline constexpr std::int64_t kTicksPerMicrosecond = 60;  // of a Kinect v1's clock

/// @brief A Kinect v1's clock, which counts 60 MHz ticks in 32 bits and so begins anew each 71.6 s,
/// as one that goes on.
class TickClock {
 public:
  /// @brief Time of an image [us]. Images of two streams may come a little out of order.
  std::int64_t microseconds(std::uint32_t ticks) {
    if (last_) total_ += static_cast<std::int32_t>(ticks - *last_);
    last_ = ticks;
    return total_ / kTicksPerMicrosecond;
  }

 private:
  std::optional<std::uint32_t> last_;
  std::int64_t total_ = 0;  // since the first image
};

}  // namespace geomap::drivers
