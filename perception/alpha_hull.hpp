// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace geomap::perception {

/// @brief Alpha shape of a point set in the plane: its connected groups, and the borders of its area.
struct AlphaHull {
  std::vector<int> group;  // per point, from 0; numbered by each group's first point
  int groups = 0;
  /// Closed rings of indices of points; the area is on their left, so outer rings run counter-clockwise
  /// and holes clockwise. A ring may pass a point twice, where the area is pinched.
  std::vector<std::vector<std::uint32_t>> rings;
  std::vector<int> ring_group;  // per ring
};

/// @brief The regularised alpha shape (paper: concave hull): all Delaunay triangles whose circumscribed
/// circle is no larger than `radius`, which may differ from point to point (a triangle takes the
/// largest of its three corners). No ring is ever dropped: groups of several rings are areas with holes
/// or of several parts.
///
/// Points whose distance is at most `link` times the larger of their radii are of one group. The
/// shortest links between any two groups are Delaunay edges, so one triangulation serves both.
/// Coinciding points count once; fewer than three points, or collinear ones, have no area.
/// @throws std::invalid_argument unless both spans have one size, all values are finite, radii positive.
AlphaHull alpha_hull(std::span<const Eigen::Vector2d> points, std::span<const double> radius,
                     double link);

}  // namespace geomap::perception
