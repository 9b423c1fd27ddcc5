// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "geometry/rgbd_frame.hpp"
#include "perception/depth_cells.hpp"
#include "perception/plane_extractor.hpp"

namespace geomap::perception {

/// @brief The label that all pixels of a cell have; kNoPlane where they differ, or where the cell
/// is not whole.
/// @param label per pixel of the depth image
inline std::int16_t common_label(const std::vector<std::int16_t>& label,
                                 const geometry::DepthImage& depth, int column, int row) {
  constexpr int kSide = DepthCells::kSide;
  static_assert(kSide * sizeof(std::int16_t) == sizeof(std::uint64_t));
  const int u = column * kSide, v = row * kSide;
  if (u + kSide > depth.width || v + kSide > depth.height) return kNoPlane;
  const std::int16_t* first = label.data() + static_cast<std::ptrdiff_t>(v) * depth.width + u;
  std::array<std::uint64_t, kSide> rows;
  for (std::size_t j = 0; j < kSide; ++j) {
    std::memcpy(&rows[j], first + static_cast<std::ptrdiff_t>(j) * depth.width, sizeof rows[j]);
  }
  const bool is_common = rows[0] == std::rotl(rows[0], 16) && rows[1] == rows[0] &&
                         rows[2] == rows[0] && rows[3] == rows[0];
  return is_common ? *first : kNoPlane;
}

}  // namespace geomap::perception
