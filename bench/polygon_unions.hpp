// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

#include "geometry/polygon.hpp"

namespace geomap::bench {

/// @brief Unites two polygons that were converted to the library's own kind before; returns the
/// number of parts.
using Union = std::function<std::size_t()>;

/// @brief CGAL::Polygon_set_2 on exact numbers.
Union cgal_union(const geometry::Polygon& a, const geometry::Polygon& b);

/// @brief boost::geometry::union_ on double.
Union boost_union(const geometry::Polygon& a, const geometry::Polygon& b);

}  // namespace geomap::bench
