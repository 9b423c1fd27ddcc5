// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "geometry/polygon.hpp"

namespace geomap::geometry {

/// @brief Fewer vertices within a bounded error: every vertex left out is at most `tolerance` [m] from
/// the new outline. Holes and parts smaller than tolerance² are dropped. The result holds the
/// invariant of `Polygon`; where that would not, a smaller tolerance is used.
/// @param is_fixed vertices for which it is true stay; none are fixed by default.
Polygon simplify(const Polygon& polygon, double tolerance,
                 const std::function<bool(GridPoint)>& is_fixed = {});

}  // namespace geomap::geometry
