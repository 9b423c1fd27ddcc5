// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace geomap::perception {

/// @brief What of one block of a depth image lies on the surface of its centre, see thin_frame().
struct BlockSum {
  std::int32_t differences = 0;  // of depths from the centre's, summed [mm]
  std::int32_t pixels = 0;       // the centre among them; 0 where it is no reading
  std::uint8_t beside = 0;       // bit i: the pixel i - kBeside columns from the centre is one

  static constexpr int kBeside = 3;
};

/// @brief How far from the centre's depth a reading of the same surface may be [mm]: a plane seen
/// at 70 degrees changes by 1.5 % over three pixels of a Kinect.
constexpr int same_surface(int centre) { return 10 + centre / 64; }

/// @brief Columns that are read from a block's first one on, whatever its width.
inline constexpr int kBlockLanes = 8;

/// @brief The same for `count` blocks of step x step pixels side by side, for the steps that occur:
/// a row of a block is one register.
/// @param centre of the first block; the next is `step` columns on. Every block lies in the image
/// of `width` columns, and so do the kBlockLanes columns from its first one on.
/// @return false for other steps; nothing is done.
bool sum_blocks(const std::uint16_t* centre, int width, int step, int count, BlockSum* sums);

}  // namespace geomap::perception
