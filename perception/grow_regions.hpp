// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/plane.hpp"
#include "perception/cell_normals.hpp"
#include "perception/depth_cells.hpp"
#include "perception/depth_tolerance.hpp"

namespace geomap::perception {

/// @brief Planes of a depth image, and the cells that are on them.
struct CellRegions {
  std::vector<geometry::Plane> planes;   // normals towards the camera (d > 0)
  std::vector<std::int16_t> cell_label;  // per cell: index into planes, or kNoPlane
};

/// @brief Planes grown over neighbouring cells from the flattest places outwards: a cell joins
/// where its mean is on the region's plane, fitted again as it grows, and its own normal agrees.
/// Then regions that touch and are one surface under the sensor's tolerance are joined, and those
/// that noise makes up across an edge are dropped.
/// @param max_normal_angle between a cell's normal and its region's plane [rad]
/// @param max_merge_angle between regions that may be joined [rad]
CellRegions grow_regions(const DepthCells& cells, const std::vector<CellNormal>& normals,
                         const DepthTolerance& tolerance, double max_normal_angle,
                         double max_merge_angle);

}  // namespace geomap::perception
