// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <time.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace geomap::bench {

/// @brief 0 for no values.
inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}
inline double median(const std::vector<double>& values) { return quantile(values, 0.5); }

/// @brief Processor time of this thread so far [ms]: on an idle machine the wall's, and hardly more
/// on a busy one.
inline double processor_milliseconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

/// @brief Processor time that `work` takes [ms].
template <typename Work>
double milliseconds(Work&& work) {
  const double start = processor_milliseconds();
  work();
  return processor_milliseconds() - start;
}

}  // namespace geomap::bench
