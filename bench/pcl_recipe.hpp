// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "geometry/rgbd_frame.hpp"

namespace geomap::bench {

struct PclRecipeResult {
  std::size_t planes = 0;
  std::size_t vertices = 0;
};

/// @brief The paper's plane extraction as PCL's classes give it, with the settings the authors
/// released: voxels 4 cm; Euclidean clusters 6 cm, 50 points; RANSAC planes 4 cm, 100 iterations
/// until fewer than 50 points are left; inliers clustered again, projected; concave hull with alpha
/// 0.2 m.
PclRecipeResult pcl_recipe(const geometry::RgbdFrame& frame);

}  // namespace geomap::bench
