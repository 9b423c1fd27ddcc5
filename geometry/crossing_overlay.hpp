// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/polygon.hpp"

namespace geomap::geometry {

/// @brief One operand of `trace_intersection`: a polygon, or all of the plane but a polygon.
struct Operand {
  const Polygon& polygon;
  bool is_complement = false;
};

/// @brief Border of the area that two operands share, where their borders meet in crossings only:
/// the rings are followed from crossing to crossing, always into the other area (Weiler, Atherton,
/// "Hidden surface removal using polygon area sorting", SIGGRAPH 1977). Nothing where the borders
/// touch or share a stretch.
///
/// Costs little more than copying the rings. The shared area lies on the left of every ring;
/// crossings are rounded to the grid, after which rings may touch or cross.
std::optional<std::vector<Ring>> trace_intersection(const Operand& a, const Operand& b);

}  // namespace geomap::geometry
