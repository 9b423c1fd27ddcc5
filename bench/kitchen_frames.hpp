// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "geometry/rgbd_frame.hpp"

namespace geomap::bench {

/// @brief Every `step`-th depth frame of the recorded kitchen under GEOMAP_DATA, decoded; empty
/// where the recording is missing.
std::vector<geometry::RgbdFrame> load_kitchen_frames(int step);

}  // namespace geomap::bench
