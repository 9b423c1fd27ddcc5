// SPDX-License-Identifier: BSD-3-Clause
#include "perception/thin_blocks.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "geometry/multiversion.hpp"
#include "geometry/rgbd_frame.hpp"

namespace geomap::perception {
namespace {

// The pixels of a block's row. The extension is the same in g++ and clang, on any processor.
using Lanes = std::uint16_t __attribute__((vector_size(2 * kBlockLanes)));

// Those of a block's row: its last lanes are the next block's.
template <int step>
constexpr Lanes kInBlock = {0xffff,
                            0xffff,
                            0xffff,
                            step > 3 ? 0xffff : 0,
                            step > 3 ? 0xffff : 0,
                            step > 5 ? 0xffff : 0,
                            step > 5 ? 0xffff : 0,
                            0};

template <int step>
[[gnu::always_inline]] inline void reverse(Lanes& row) {
  if constexpr (step == 7) row = __builtin_shufflevector(row, row, 6, 5, 4, 3, 2, 1, 0, 7);
  if constexpr (step == 5) row = __builtin_shufflevector(row, row, 4, 3, 2, 1, 0, 5, 6, 7);
  if constexpr (step == 3) row = __builtin_shufflevector(row, row, 2, 1, 0, 3, 4, 5, 6, 7);
}

// All ones where a pixel is a reading on the surface of the centre.
[[gnu::always_inline]] inline void belonging(const Lanes& row, std::uint16_t centre, Lanes& mask) {
  constexpr int kFarthest = geometry::DepthImage::kInvalid - 1;
  const int reach = same_surface(centre);
  const int nearest = std::max(centre - reach, geometry::DepthImage::kNoReading + 1);
  const int farthest = std::min(centre + reach, kFarthest);
  // Unsigned: what is nearer wraps, and is then too far.
  const Lanes beyond = row - static_cast<std::uint16_t>(nearest);
  mask = (Lanes)(beyond <= static_cast<std::uint16_t>(farthest - nearest));
}

template <int step>
[[gnu::always_inline]] inline BlockSum sum_block(const std::uint16_t* centre, int width) {
  constexpr int kRadius = step / 2;
  const std::uint16_t depth = *centre;
  if (!geometry::DepthImage::is_reading(depth)) return {};
  Lanes row, opposite, mask, mirrored;
  const auto load = [&](int dv, Lanes& into) {
    std::memcpy(&into, centre + static_cast<std::ptrdiff_t>(dv) * width - kRadius, sizeof into);
  };
  load(0, row);
  belonging(row, depth, mask);
  mirrored = mask & kInBlock<step>;
  reverse<step>(mirrored);
  mask &= mirrored;
  const Lanes middle = mask;
  Lanes differences = (row - depth) & mask;  // signed: at most 49 times 1033 mm in eight lanes
  Lanes pixels = mask;                       // counts downwards
  for (int dv = 1; dv <= kRadius; ++dv) {
    load(dv, row);
    load(-dv, opposite);
    reverse<step>(opposite);
    belonging(row, depth, mask);
    belonging(opposite, depth, mirrored);
    mask &= mirrored & kInBlock<step>;
    differences += ((row - depth) & mask) + ((opposite - depth) & mask);
    pixels += mask + mask;
  }
  BlockSum sum;
  for (int i = 0; i < step; ++i) {
    sum.differences += static_cast<std::int16_t>(differences[i]);
    sum.pixels -= static_cast<std::int16_t>(pixels[i]);
    sum.beside = static_cast<std::uint8_t>(sum.beside | (middle[i] & 1)
                                                            << (i + BlockSum::kBeside - kRadius));
  }
  return sum;
}

}  // namespace

GEOMAP_MULTIVERSION bool sum_blocks(const std::uint16_t* centre, int width, int step, int count,
                                    BlockSum* sums) {
  switch (step) {
    case 3:
      for (int k = 0; k < count; ++k) sums[k] = sum_block<3>(centre + 3 * k, width);
      return true;
    case 5:
      for (int k = 0; k < count; ++k) sums[k] = sum_block<5>(centre + 5 * k, width);
      return true;
    case 7:
      for (int k = 0; k < count; ++k) sums[k] = sum_block<7>(centre + 7 * k, width);
      return true;
    default:
      return false;
  }
}

}  // namespace geomap::perception
