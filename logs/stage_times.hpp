// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace geomap::logs {

/// @brief Wall-clock time of each stage for one key frame [s]; for profiling, never for decisions.
struct StageTimes {
  double decode = 0.0;
  double registration = 0.0;  // with the insertion into the point map
  double extraction = 0.0;
  double hull = 0.0;
  double merging = 0.0;
  double total() const { return decode + registration + extraction + hull + merging; }
};

/// @brief Mean and order statistics of a series.
struct Summary {
  double mean = 0.0;
  double p50 = 0.0;
  double p95 = 0.0;
  double max = 0.0;
};

/// @brief Summary of a series in any order; zeros for an empty one. Percentiles by nearest rank.
Summary summarize(std::vector<double> values);

}  // namespace geomap::logs
