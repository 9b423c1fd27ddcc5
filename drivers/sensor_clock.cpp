// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/sensor_clock.hpp"

#include <algorithm>

namespace geomap::drivers {
namespace {

constexpr std::int64_t kWindow = 2'000'000;     // two of them are looked at [us]
constexpr std::int64_t kLongestStep = 100'000;  // that is no jump of the sensor's clock [us]

}  // namespace

std::int64_t SensorClock::to_host(std::int64_t sensor_time, std::int64_t arrival) {
  const std::int64_t offset = arrival - sensor_time;
  if (is_started_ && sensor_time < last_sensor_) {
    ++restarts_;
    window_least_ = previous_least_ = kNone;
    window_start_ = last_sensor_ = sensor_time;
  }
  observe(sensor_time, offset);
  std::int64_t host = sensor_time + std::min(window_least_, previous_least_);
  if (is_started_) {
    // When the host's clock is set back, time goes on at half its pace until that has caught up.
    const std::int64_t elapsed = sensor_time - last_sensor_;
    host = std::max(host, last_host_ + std::clamp<std::int64_t>(elapsed / 2, 1, kLongestStep));
  }
  is_started_ = true;
  last_sensor_ = sensor_time;
  last_host_ = host;
  return host;
}

void SensorClock::observe(std::int64_t sensor_time, std::int64_t offset) {
  if (!is_started_) window_start_ = sensor_time;
  if (sensor_time - window_start_ >= kWindow) {
    previous_least_ = window_least_;
    window_least_ = kNone;
    window_start_ = sensor_time;
  }
  window_least_ = std::min(window_least_, offset);
}

}  // namespace geomap::drivers
