// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace geomap::perception {

/// @brief A corner between pixels: (x, y) is the upper left corner of pixel (x, y).
struct PixelCorner {
  int x = 0, y = 0;
  bool operator==(const PixelCorner&) const = default;
};

/// @brief The border of the pixels of one label, along their edges; pixels that only touch at a
/// corner are not connected. Corners where it turns; the pixels lie on the right (seen in the
/// image, whose y axis points down): `area` is positive for an outer border, negative for a hole.
struct LabelRing {
  std::int16_t label = 0;
  std::int64_t area = 0;  // [pixel]
  std::vector<PixelCorner> corners;
};

/// @brief All borders of all labels >= 0 of an image, in the order of their first pixels.
/// @param label row by row, width times height. A border belongs to one label; two neighbouring
/// labels have one each.
std::vector<LabelRing> trace_labels(const std::vector<std::int16_t>& label, int width, int height);

/// @brief The ring with fewer corners, each of them a corner of the ring; no left-out corner is
/// farther than `tolerance` [pixel] from the new border (Douglas, Peucker 1973). Fewer than three
/// corners where nothing remains.
std::vector<PixelCorner> simplify_ring(const std::vector<PixelCorner>& ring, double tolerance);

}  // namespace geomap::perception
