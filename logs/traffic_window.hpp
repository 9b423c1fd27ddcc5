// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

namespace geomap::logs {

/// @brief How messages come, over the last seconds.
struct TrafficRates {
  double hertz = 0.0;                     // 0 where that cannot be said yet
  double bandwidth = 0.0;                 // [byte/s]
  std::optional<double> mean_latency;     // [s]; nothing: no message has a latency
  std::optional<double> longest_latency;  // [s]
};

/// @brief Sums over the last seconds, in steps of a tenth, so that the memory does not grow with
/// the number of messages.
class TrafficWindow {
 public:
  explicit TrafficWindow(double seconds);

  /// @param utime when it came, host's clock [us]
  void add(std::int64_t utime, std::size_t bytes, std::optional<double> latency);
  TrafficRates rates(std::int64_t utime) const;

 private:
  static constexpr std::int64_t kSteps = 10;
  struct Step {
    std::int64_t number = -1;
    std::int64_t messages = 0, with_latency = 0;
    double bytes = 0.0, latency_sum = 0.0;
    double latency_max = std::numeric_limits<double>::lowest();
  };

  std::int64_t step_length_;  // [us]
  std::optional<std::int64_t> first_utime_;
  std::array<Step, kSteps + 1> steps_{};  // the newest one has only begun
};

}  // namespace geomap::logs
