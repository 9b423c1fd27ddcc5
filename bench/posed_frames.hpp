// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "geometry/rgbd_frame.hpp"

namespace geomap::bench {

struct PosedFrame {
  geometry::RgbdFrame frame;  // depth alone
  Eigen::Isometry3d T_world_camera;
};

/// @brief Every `step`-th of the first 500 frames of the recorded kitchen under GEOMAP_DATA with
/// their recorded poses; empty where the recording is missing.
std::vector<PosedFrame> load_posed_kitchen(int step);

}  // namespace geomap::bench
