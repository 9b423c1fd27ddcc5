// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "geometry/polygon.hpp"

namespace geomap::geometry {

/// Boolean operations on polygons of one plane frame on the 0.1 mm grid. Operands are valid
/// polygons. Every result holds the invariant of `Polygon` and is canonical: borders that only
/// cross are followed from crossing to crossing (crossing_overlay.hpp), where they touch, edges
/// are snapped to the grid (snap_overlay.hpp). Vertices move by at most a grid unit, exactly
/// collinear ones go, and parts and holes below 1 mm² are dropped. Results do not depend on the
/// order of the operands of unite and intersect.

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

/// @brief The polygon grown (distance > 0) or shrunk (< 0) by a distance [m]; mitred corners, so
/// that growing and shrinking a rectangle gives it back; corners sharper than 47° are cut off.
/// @throws std::invalid_argument when the distance is not finite or the result would leave the
/// grid.
Polygon offset(const Polygon& polygon, double distance);

}  // namespace geomap::geometry
