// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/polygon.hpp"
#include "geometry/snap_overlay.hpp"

namespace geomap::geometry {

/// @brief Rings with the area on their left.
struct TracedBorder {
  std::vector<Ring> rings;
  bool has_crossings = false;  // rounded to the grid, after which rings may touch or cross
};

/// @brief Border of the area of two polygons that `inside` tells, where their borders meet in
/// crossings only: winding numbers are carried along the rings from crossing to crossing, and the
/// stretches that bound the area are joined (after Weiler, Atherton, "Hidden surface removal using
/// polygon area sorting", SIGGRAPH 1977). Nothing where borders touch or share a stretch.
///
/// Costs little more than copying the rings.
std::optional<TracedBorder> trace_overlay(const Polygon& a, const Polygon& b, InsideRule inside);

/// @brief The same for the area of any rings, which may cross themselves and each other; they are
/// the rule's first operand.
std::optional<TracedBorder> trace_overlay(std::span<const Ring> rings, InsideRule inside);

}  // namespace geomap::geometry
