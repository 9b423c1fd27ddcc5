// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "geometry/polygon.hpp"

namespace geomap::logs {

/// @brief How far the vertices of outlines are from the border of a true area [m].
struct HullDistance {
  std::size_t vertices = 0;
  double mean = 0.0;
  double max = 0.0;
};

/// @brief Of the vertices of the outer rings, each to the nearest border of `truth`, its holes
/// included. All are in one frame. Empty without vertices or without `truth`.
std::optional<HullDistance> hull_distance(std::span<const geometry::Polygon> outlines,
                                          const geometry::Polygon& truth);

/// @brief Of the vertices of both.
HullDistance joined(const HullDistance& a, const HullDistance& b);

}  // namespace geomap::logs
