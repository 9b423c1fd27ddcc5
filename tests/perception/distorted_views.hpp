// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "geometry/depth_correction.hpp"
#include "support/plane_renderer.hpp"

namespace geomap::perception {

/// @brief A bowl as Kinects have it, and a twist: up to 8 thousandths of the depth.
geometry::DepthCorrection bowl();

/// @brief The frame as a camera with this fixed error would have read it: z' = z / (1 + s).
geometry::RgbdFrame distorted(const testing::Rendering& rendering,
                              const geometry::DepthCorrection& correction);

/// @brief Forty poses in the small room, of a robot that looks around: it sees the same surfaces
/// at all places of the image.
std::vector<Eigen::Isometry3d> poses_around_the_room();

}  // namespace geomap::perception
