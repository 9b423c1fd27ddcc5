// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "perception/cell_normals.hpp"
#include "perception/depth_cells.hpp"

namespace geomap::perception {

/// @brief Mean of the planar cells in one cube of space, camera frame.
struct Voxel {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();    // [m]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit, towards the camera
  double pixels = 0.0;
};

/// @brief A depth image thinned for clustering and RANSAC.
struct VoxelCloud {
  std::vector<Voxel> voxels;       // in the order of their first cell
  std::vector<int> voxel_of_cell;  // -1: the cell is not planar, or its voxel's normals disagree
};

/// @brief Coordinates in which a depth image's points are equally dense: metres up to `reference`
/// [m], beyond it all lengths shrink with 1/depth. Voxel size and cluster tolerance apply in them,
/// so both grow with range as the pixels' spacing does.
Eigen::Vector3d evenly_dense(const Eigen::Vector3d& point, double reference);

/// @brief Voxel filter over the planar cells.
/// @param leaf edge of a voxel [m], up to the range `reference` [m].
VoxelCloud make_voxel_cloud(const DepthCells& cells, const std::vector<CellNormal>& normals,
                            double leaf, double reference);

}  // namespace geomap::perception
