// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "perception/voxel_cloud.hpp"

namespace geomap::perception {

/// @brief Voxels in groups no two of which come closer than `tolerance` [m] (paper: Euclidean
/// clustering), by PCL. Distances are those of `evenly_dense`. Groups of fewer than `least` voxels
/// are left out; indices ascend within a group, larger groups come first.
std::vector<std::vector<int>> euclidean_clusters(const VoxelCloud& cloud, double tolerance,
                                                 double reference, int least);

}  // namespace geomap::perception
