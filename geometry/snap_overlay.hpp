// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "geometry/planar_map.hpp"
#include "geometry/polygon.hpp"

namespace geomap::geometry {

/// @brief Boolean operation on any rings, whatever coincides: the way out where borders touch.
///
/// Edges are rounded to the grid by snap rounding (Hobby, "Practical segment intersection with
/// finite precision output", Comput. Geom. 1999): each is led through the centres of all grid cells
/// on its way that hold a vertex or an intersection. Then edges meet in common ends only, which
/// makes winding numbers, connected areas and rings a matter of counting, and the result valid by
/// construction. Vertices move by at most one grid unit. Equal areas give equal polygons. Time
/// grows with the square of the number of edges in the worst case.
Polygon snap_overlay(std::span<const Ring> a, std::span<const Ring> b, InsideRule inside);

/// @brief Parts from rings that do not cross: counter-clockwise ones are outer rings, each
/// clockwise one is a hole of the smallest outer ring around it. Canonical, without collinear
/// vertices.
Polygon assemble_parts(const std::vector<Ring>& rings);

}  // namespace geomap::geometry
