// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>

namespace geomap::drivers {

/// @brief Maps a sensor's clock to the host's. Images arrive late by a varying delay, so the least
/// difference of both clocks over the last few seconds counts: it follows a drift (100 ppm are
/// 0.4 ms in that time) and forgets a step of either clock.
class SensorClock {
 public:
  /// @param sensor_time of an image [us]. @param arrival of it, host's clock [us].
  /// @return host's time of the image [us]; later than any returned before.
  std::int64_t to_host(std::int64_t sensor_time, std::int64_t arrival);

  /// @brief How often the sensor's clock went back, as when it wraps or the camera is reset.
  std::int64_t restarts() const { return restarts_; }

 private:
  static constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::max();

  void observe(std::int64_t sensor_time, std::int64_t offset);

  std::int64_t window_start_ = 0;      // sensor's clock [us]
  std::int64_t window_least_ = kNone;  // host minus sensor [us]
  std::int64_t previous_least_ = kNone;
  std::int64_t last_sensor_ = 0, last_host_ = 0;
  bool is_started_ = false;
  std::int64_t restarts_ = 0;
};

}  // namespace geomap::drivers
