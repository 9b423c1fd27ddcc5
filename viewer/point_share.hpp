// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <span>
#include <vector>

namespace geomap::viewer {

/// @brief The live cloud may take one in so many of the points that are drawn, the point map the
/// others.
inline constexpr std::size_t kCloudShare = 5;

/// @brief A block of points that asks to be drawn.
struct PointClaim {
  std::size_t points = 0;
  double weight = 1.0;  // share of its points, against that of the others; above 0
};

/// @brief How many points of each block are drawn: in all no more than the budget, each block the
/// same share times its weight, none more than it has.
std::vector<std::size_t> share_points(std::span<const PointClaim> claims, std::size_t budget);

/// @brief False only when the box lies wholly outside the view (conservative).
/// @param clip_from_world ViewCamera::view_projection().
bool may_be_seen(const Eigen::Matrix4d& clip_from_world, const Eigen::AlignedBox3d& box);

}  // namespace geomap::viewer
