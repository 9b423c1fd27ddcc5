// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/plane.hpp"
#include "perception/depth_cells.hpp"
#include "perception/depth_tolerance.hpp"
#include "perception/plane_pixels.hpp"

namespace geomap::perception {

/// @brief Planes fitted to their pixels, and where they are.
struct FittedPlanes {
  std::vector<geometry::Plane> planes;
  std::vector<std::int16_t> cell_label;  // per cell: index into planes, or kNoPlane
};

/// @brief Fits each plane to its pixels, and joins planes that touch in the image and are one
/// surface under the sensor's tolerance: what RANSAC cut in two, and second shells that it found in
/// the left-overs of a surface. Planes without a fit, and mere speckle, are dropped.
/// @param max_angle between planes that may be joined [rad]; shells may be turned by twice as much
/// @param row_step with which the pixels were assigned
FittedPlanes fit_and_merge(const DepthCells& cells, const PlanePixels& pixels,
                           const DepthTolerance& tolerance, double max_angle, int row_step);

}  // namespace geomap::perception
