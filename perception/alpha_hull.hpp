// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace geomap::perception {

/// @brief The regularised alpha shape of points in the plane (paper: concave hull): the union of
/// all Delaunay triangles whose circumscribed circle is no larger than `radius`, which may differ
/// from point to point (a triangle takes the largest of its three corners).
///
/// Returns the area's whole border as closed rings of indices of points, in no particular order,
/// with the area on the left: outer rings run counter-clockwise, holes clockwise; an area of
/// several parts has several outer rings. A ring may pass a point twice, where the area is pinched.
/// Coinciding points count once; fewer than three points, or collinear ones, have no area.
/// @throws std::invalid_argument unless both spans have one size, all values are finite, radii
/// positive.
std::vector<std::vector<std::uint32_t>> alpha_hull(std::span<const Eigen::Vector2d> points,
                                                   std::span<const double> radius);

}  // namespace geomap::perception
