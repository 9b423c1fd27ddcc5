// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/rgbd_frame.hpp"
#include "perception/cell_normals.hpp"
#include "perception/depth_cells.hpp"
#include "perception/depth_tolerance.hpp"
#include "perception/surface_region.hpp"

namespace geomap::perception {

/// @brief What decides whether a reading is on a plane.
struct LabelSettings {
  double near = 0.0, far = 0.0;   // other readings are on none [m]
  double max_normal_angle = 0.0;  // between a cell's normal and its plane's [rad]
};

/// @brief Assigns every reading to the plane it fits best, among the planes known in the
/// neighbourhood of its cell: within the depth tolerance at its range, and not where the cell's own
/// normal says otherwise.
/// @return per pixel the index of its plane, or kNoPlane.
std::vector<std::int16_t> label_pixels(const geometry::RgbdFrame& frame, const DepthCells& cells,
                                       const std::vector<CellNormal>& normals,
                                       const DepthTolerance& tolerance, const CellRegions& regions,
                                       const LabelSettings& settings);

}  // namespace geomap::perception
