// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "geometry/polygon.hpp"

namespace geomap::geometry {

/// Boolean operations on polygons of one plane frame by Vatti's algorithm (Clipper) on the 0.1 mm grid.
/// Every result holds the invariant of `Polygon`; where the clipper leaves rings that touch themselves
/// they are split or opened by at most a few grid units. Slivers below 1 mm² are dropped.

/// @brief How rings that overlap or cross themselves are read.
enum class FillRule { kNonZero, kEvenOdd };

/// @brief A valid polygon from any rings: crossing, touching, repeated vertices, any orientation.
Polygon from_rings(std::span<const Ring> rings, FillRule rule);

/// @brief Area covered by either (paper, equation 11).
Polygon unite(const Polygon& a, const Polygon& b);
/// @brief Area covered by any of them.
Polygon unite(std::span<const Polygon> polygons);
/// @brief Area covered by both.
Polygon intersect(const Polygon& a, const Polygon& b);
/// @brief Area of `a` that `b` does not cover.
Polygon subtract(const Polygon& a, const Polygon& b);

/// @brief The polygon grown (distance > 0) or shrunk (< 0) by a distance [m]; mitred corners, so that
/// growing and shrinking a rectangle gives it back.
Polygon offset(const Polygon& polygon, double distance);

}  // namespace geomap::geometry
