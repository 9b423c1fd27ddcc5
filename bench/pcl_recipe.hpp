// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "geometry/rgbd_frame.hpp"

namespace geomap::bench {

struct PclRecipeResult {
  std::size_t planes = 0;
  std::size_t vertices = 0;
};

/// @brief The settings that the paper's authors released.
struct PclRecipeSettings {
  float leaf = 0.04F;               // of the voxel grid [m]
  double cluster_tolerance = 0.06;  // [m]
  int least_points = 50;            // of a cluster, of a plane
  double plane_threshold = 0.04;    // of RANSAC [m]
  double alpha = 0.2;               // of the concave hull [m]
};

/// @brief The same recipe for what 4 cm are too coarse for.
inline constexpr PclRecipeSettings kFinePclRecipe = {0.02F, 0.05, 200, 0.02, 0.1};

/// @brief The paper's plane extraction as PCL's classes give it: voxels; Euclidean clusters; RANSAC
/// planes, 100 iterations each, until too few points are left; inliers clustered again, projected;
/// concave hull.
PclRecipeResult pcl_recipe(const geometry::RgbdFrame& frame,
                           const PclRecipeSettings& settings = {});

}  // namespace geomap::bench
