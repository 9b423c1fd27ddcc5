// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "perception/cell_normals.hpp"
#include "perception/depth_cells.hpp"
#include "perception/depth_tolerance.hpp"
#include "perception/surface_region.hpp"

namespace geomap::perception {

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
