// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/plane.hpp"
#include "perception/depth_tolerance.hpp"
#include "perception/voxel_cloud.hpp"

namespace geomap::perception {

/// @brief A plane of voxels, normal towards the camera.
struct VoxelPlane {
  geometry::Plane plane;
  std::vector<int> voxels;  // ascending
};

struct RansacSettings {
  int iterations = 100;            // at most, per plane
  int least_voxels = 8;            // of a plane
  double sample_radius = 0.5;      // of the three points of a sample [m]
  double max_normal_angle = 0.44;  // between a voxel's and the plane's normal [rad]
};

/// @brief RANSAC planes of one cluster until nothing is left (paper, plane extraction), by PCL's
/// RandomSampleConsensus with a model of our own: a voxel belongs to a plane when it is within the
/// depth tolerance *at its range* and its normal agrees, so that planes neither tilt over step
/// edges nor collect strips of crossing surfaces. Each plane found is fitted again to its voxels,
/// weighted by depth noise, until its voxels no longer change.
/// @param seed of the samples; nothing else is random.
std::vector<VoxelPlane> ransac_planes(const VoxelCloud& cloud, const std::vector<int>& cluster,
                                      const DepthTolerance& tolerance,
                                      const RansacSettings& settings, std::uint64_t seed);

}  // namespace geomap::perception
