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

namespace geomap::perception {

/// @brief The pixels of one plane within one cell.
struct PlaneCell {
  int cell = 0;
  int pixels = 0;
  bool is_whole = false;    // all readings of the cell are the plane's
  Eigen::AlignedBox2i box;  // of the pixels (u, v)
};

/// @brief Which pixel belongs to which plane, and in which cells the planes are.
struct PlanePixels {
  std::vector<std::int16_t> label;            // per pixel: index of the plane, or kNoPlane
  std::vector<std::vector<PlaneCell>> cells;  // per plane, cells ascending
};

/// @brief Sorts labelled pixels by plane and cell. @param label per pixel, below `planes`.
PlanePixels collect_pixels(const geometry::RgbdFrame& frame, const DepthCells& cells,
                           std::vector<std::int16_t> label, std::size_t planes);

/// @brief Cells of one plane that belong together, ascending; they belong to a PlanePixels.
using PlanePart = std::vector<const PlaneCell*>;

/// @brief Where the pixels of a part are within one cell, on average.
struct CellPoint {
  Eigen::Vector3d mean;  // camera frame [m]
  double pixels = 0.0;
};

/// @brief Sums over the pixels of a part.
struct PartSums {
  geometry::PlaneMoments moments;  // camera frame, weights 1/σ_z² at each cell's mean depth
  std::int64_t pixels = 0;
  std::array<double, 3> color{};  // red, green, blue; zero without colour of the depth's size
  std::vector<CellPoint> points;  // of each cell, or every second one, or third, if there are many
};

/// @brief Sums up the pixels with the label `plane` in the cells of a part.
PartSums sum_part(const geometry::RgbdFrame& frame, const DepthCells& cells,
                  const geometry::DepthNoise& noise, const std::vector<std::int16_t>& label,
                  std::int16_t plane, const PlanePart& part);

}  // namespace geomap::perception
