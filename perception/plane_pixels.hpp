// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/depth_noise.hpp"
#include "geometry/plane_moments.hpp"
#include "geometry/rgbd_frame.hpp"
#include "perception/depth_cells.hpp"
#include "perception/pixel_labels.hpp"

namespace geomap::perception {

/// @brief Sums over pixels of one plane.
struct PlaneSums {
  geometry::PlaneMoments moments;  // camera frame, weights 1/σ_z²
  int pixels = 0;
  std::array<double, 3> color{};  // red, green, blue; zero without colour of the depth's size

  PlaneSums& operator+=(const PlaneSums& other);
};

/// @brief The pixels of one plane within one cell.
struct PlaneCell {
  int cell = 0;
  PlaneSums sums;
  Eigen::AlignedBox2i box;  // of the pixels (u, v)
};

/// @brief Which pixel belongs to which plane, and the planes' sums.
struct PlanePixels {
  std::vector<std::int16_t> label;       // per pixel: index of the plane, or kNoPlane
  std::vector<std::int16_t> cell_label;  // per cell: the plane of most of its pixels, or kNoPlane
  std::vector<std::vector<PlaneCell>> cells;  // per plane, cells ascending
};

/// @brief Sums up labelled pixels, cell by cell.
/// @param label per pixel, below `planes`.
/// @param row_step with which they were labelled.
PlanePixels sum_pixels(const geometry::RgbdFrame& frame, const DepthCells& cells,
                       const geometry::DepthNoise& noise, std::vector<std::int16_t> label,
                       std::size_t planes, int row_step = 1);

}  // namespace geomap::perception
