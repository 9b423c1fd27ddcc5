// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace geomap::messaging {

/// @brief How long something takes: counts in classes that grow by a twentieth, from 1 µs on, so
/// that the memory does not grow with the number of runs. Quantiles are good to 5 %.
class Latency {
 public:
  void add(double seconds);

  std::int64_t count() const { return count_; }
  /// @brief The time that a share of the runs does not exceed [s]; 0 without any.
  double quantile(double share) const;
  double max() const { return max_; }  // [s]

 private:
  static constexpr int kClasses = 400;  // up to 300 s
  std::array<std::int64_t, kClasses> counts_{};
  std::int64_t count_ = 0;
  double max_ = 0.0;
};

}  // namespace geomap::messaging
