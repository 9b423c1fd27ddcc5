// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace geomap::bench {

/// @brief Vertices of the concave hull of points in a plane by pcl::ConcaveHull.
/// @param alpha largest circumscribed circle of a triangle, radius [m].
std::size_t pcl_concave_hull(const std::vector<Eigen::Vector2d>& points, double alpha);

/// @brief Edges of the border by CGAL::Alpha_shape_2, regularised; `alpha` likewise.
std::size_t cgal_alpha_shape(const std::vector<Eigen::Vector2d>& points, double alpha);

}  // namespace geomap::bench
