// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "geometry/polygon.hpp"

namespace geomap::geometry {

/// @brief Fewer vertices within a bounded error: every vertex of the input is at most `tolerance`
/// [m] from the new outline, every new vertex at most as far from the old one.
///
/// An edge shrinks to one point, placed so that the area stays the same (Kronenfeld, Stanislawski,
/// Buttenfield, Brockmeyer, "Simplification of polylines by segment collapse", IJC 2020), the
/// smallest error first: jagged borders become their mean line, corners where mean lines meet, and
/// the area does not drift. Beside a fixed vertex a single vertex is left out instead. Holes and
/// parts smaller than tolerance² without fixed vertices are dropped. The result holds the invariant
/// of `Polygon`; where that would not, a smaller tolerance is used.
/// @param is_fixed vertices for which it is true stay where they are (unless they lie straight
/// between their neighbours); none are fixed by default.
/// @throws std::invalid_argument when the tolerance is negative or not finite.
Polygon simplify(const Polygon& polygon, double tolerance,
                 const std::function<bool(GridPoint)>& is_fixed = {});

}  // namespace geomap::geometry
