// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "drivers/frame_source.hpp"
#include "geometry/rgbd_frame.hpp"

namespace geomap::bench {

struct PosedFrame {
  geometry::RgbdFrame frame;  // depth alone
  Eigen::Isometry3d T_world_camera;
};

using FrameVisitor = std::function<void(drivers::SourceFrame)>;

/// @brief Hands out every `step`-th of the first 500 frames of the recorded kitchen under
/// GEOMAP_DATA with its recorded pose; none where the recording is missing.
void visit_kitchen(int step, const FrameVisitor& visitor);

/// @brief The same frames without their colour.
std::vector<PosedFrame> load_posed_kitchen(int step);

}  // namespace geomap::bench
