// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perception/tracker.hpp"

namespace geomap::bench {

struct RegistrationBenchSettings {
  perception::TrackerConfig tracker;
  int seeds = 10;     // disturbances of each pair, from 1 on
  int pcl_seeds = 2;  // of those, how many PCL gets as well
  int step = 10;      // frames between the two of a pair
};

/// @brief Pairs of kitchen frames from a disturbed relative pose: ours beside PCL's.
void bench_pairs(const RegistrationBenchSettings& settings);

/// @brief Where the time of a key frame goes, over the kitchen's key frames.
void bench_profile(const RegistrationBenchSettings& settings);

/// @brief The same view against maps of 1, 10 and 100 rooms.
void bench_growth(const RegistrationBenchSettings& settings);

}  // namespace geomap::bench
