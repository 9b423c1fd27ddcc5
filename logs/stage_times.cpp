// SPDX-License-Identifier: BSD-3-Clause
#include "logs/stage_times.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace geomap::logs {

Summary summarize(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto count = static_cast<double>(values.size());
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(std::ceil(share * count)) - 1];
  };
  return {std::accumulate(values.begin(), values.end(), 0.0) / count, at(0.5), at(0.95),
          values.back()};
}

}  // namespace geomap::logs
