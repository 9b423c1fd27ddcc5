// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "geometry/polygon.hpp"

namespace geomap::geometry {

inline constexpr double kMitreLimit =
    2.5;  // corners sharper than 47° are cut off [offset distances]

/// @brief The rings of a polygon with every edge moved outward by a distance [grid unit], or inward
/// where it is negative. The grown or shrunk area is where their winding number is positive: edges
/// that are too short for the distance leave loops that run the other way.
/// @param polygon valid; the result must lie on the grid.
std::vector<Ring> offset_rings(const Polygon& polygon, double distance);

}  // namespace geomap::geometry
