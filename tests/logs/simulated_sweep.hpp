// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "drivers/data_set_writer.hpp"
#include "logs/replay.hpp"

namespace geomap::testing {

/// @brief A drive through a scene of config/scenes: writes sweep.lcmlog and sweep.truth.yaml, and
/// the replay's results to out/. @param sigma of depth [m] @param rate frames a second
logs::ReplayResult replay_sweep(const TemporaryFolder& folder, const std::string& scene,
                                double sigma, double rate = 5.0);

}  // namespace geomap::testing
