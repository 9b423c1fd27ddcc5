// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/polygon.hpp"

namespace geomap::geometry {

/// @brief Triangles (counter-clockwise) over the vertices of a polygon.
struct Triangulation {
  std::vector<GridPoint> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // indices into vertices
};

/// @brief Constrained Delaunay triangulation of the polygon's inside; holes stay open. Area equals
/// the polygon's. Empty for an empty polygon.
Triangulation triangulate(const Polygon& polygon);

}  // namespace geomap::geometry
