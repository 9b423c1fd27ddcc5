// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace geomap::perception {

/// @brief Readings of one row of a depth image on their way into the voxels. Fine units.
struct VoxelRow {
  std::array<double, 3> origin;  // camera, less a whole number of fine units
  std::array<double, 3> ray;     // of the row's first pixel, per millimetre of depth
  std::array<double, 3> step;    // from one pixel's ray to the next
  double nearest, farthest;      // readings that count [mm]
};

/// @brief Places of a row's readings, rounded down, and whether they count.
void place_readings(const VoxelRow& row, const std::uint16_t* millimetres, int count,
                    const std::array<std::int32_t*, 3>& places, std::uint8_t* counts);

}  // namespace geomap::perception
