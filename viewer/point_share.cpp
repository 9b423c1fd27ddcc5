// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/point_share.hpp"

#include <algorithm>
#include <cmath>

namespace geomap::viewer {
namespace {

std::size_t count_at(const PointClaim& claim, double share) {
  const double wanted = std::floor(share * claim.weight * static_cast<double>(claim.points));
  return static_cast<std::size_t>(std::min(wanted, static_cast<double>(claim.points)));
}

std::size_t total_at(std::span<const PointClaim> claims, double share) {
  std::size_t total = 0;
  for (const PointClaim& claim : claims) total += count_at(claim, share);
  return total;
}

}  // namespace

std::vector<std::size_t> share_points(std::span<const PointClaim> claims, std::size_t budget) {
  double all = 0.0;  // share at which even the block of the least weight is drawn whole
  for (const PointClaim& claim : claims) all = std::max(all, 1.0 / claim.weight);
  double share = all;
  if (total_at(claims, all) > budget) {
    double low = 0.0;
    // The total grows with the share, so halving finds the largest share that keeps the budget.
    for (int i = 0; i < 40; ++i) {
      share = 0.5 * (low + all);
      (total_at(claims, share) > budget ? all : low) = share;
    }
    share = low;
  }
  std::vector<std::size_t> counts;
  counts.reserve(claims.size());
  for (const PointClaim& claim : claims) counts.push_back(count_at(claim, share));
  return counts;
}

bool may_be_seen(const Eigen::Matrix4d& clip_from_world, const Eigen::AlignedBox3d& box) {
  if (box.isEmpty()) return false;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      // Inside is where w + sign * coordinate >= 0.
      const Eigen::RowVector4d plane = clip_from_world.row(3) + sign * clip_from_world.row(axis);
      const Eigen::Vector3d normal = plane.head<3>();
      const Eigen::Vector3d farthest =
          (normal.array() > 0.0).select(box.max().array(), box.min().array());
      if (normal.dot(farthest) + plane[3] < 0.0) return false;
    }
  }
  return true;
}

}  // namespace geomap::viewer
