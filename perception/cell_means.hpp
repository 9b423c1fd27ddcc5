// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "perception/depth_cells.hpp"
#include "perception/depth_tolerance.hpp"

namespace geomap::perception {

/// @brief Where a cell's readings are on average, and how far off a plane they may be.
struct CellMean {
  float x = 0.0F, y = 0.0F, q = 0.0F;  // mean ray, mean inverse depth [1/m]; q = 0: no readings
  float allowed = 0.0F;                // of inverse depth about a plane [1/m]
};

/// @brief Means of all cells. A mean may be off by half of what a single reading may.
std::vector<CellMean> cell_means(const DepthCells& cells, const DepthTolerance& tolerance);

/// @brief Share of the tolerance of a reading that the mean of a cell's has.
inline constexpr double kMeanShare = 0.5;

}  // namespace geomap::perception
