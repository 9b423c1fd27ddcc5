// SPDX-License-Identifier: BSD-3-Clause
// What of a voxel map a camera may see.
#include <algorithm>
#include <cmath>
#include <utility>

#include "perception/voxel_map.hpp"

namespace geomap::perception {
namespace {

// Mean of a voxel's normals, readings without one counted as 0: shorter than this is an edge.
constexpr double kLeastAgreement = 0.8;

// Lowest and highest block of a column of blocks (index.x, index.y) that may lie inside a frustum,
// perhaps one too many at either end. Blocks in between are looked up, the others are not.
std::pair<int, int> levels_inside(const geometry::Frustum& frustum, const BlockIndex& column,
                                  double side) {
  double lowest = -1e9, highest = 1e9;  // [side]
  for (const geometry::Plane& plane : frustum.planes()) {
    const Eigen::Vector3d& n = plane.normal;
    // Of the column's boxes, the edge that is farthest along the inward normal.
    const double x = side * (column.x + (n.x() >= 0.0 ? 1 : 0));
    const double y = side * (column.y + (n.y() >= 0.0 ? 1 : 0));
    const double beneath = n.x() * x + n.y() * y + plane.d;  // plus n.z z: inside if not negative
    if (std::abs(n.z()) < 1e-9) continue;
    const double level = -beneath / (n.z() * side);
    if (n.z() > 0.0) lowest = std::max(lowest, level - 1.0);
    if (n.z() < 0.0) highest = std::min(highest, level);
  }
  return {static_cast<int>(std::floor(std::clamp(lowest, -1e9, 1e9))),
          static_cast<int>(std::floor(std::clamp(highest, -1e9, 1e9)))};
}

}  // namespace

SurfelSelection VoxelMap::surfels_in(const geometry::Frustum& frustum) const {
  constexpr std::size_t kUsual = 8192;
  SurfelSelection selection;
  selection.surfels.reserve(std::min(kUsual, voxels_));
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& corner : frustum.corners()) box.extend(corner);
  const double side = config_.voxel_size * MapBlock::kSide;
  if (box.min().cwiseAbs().maxCoeff() > 2.0 * kFarthest ||
      box.max().cwiseAbs().maxCoeff() > 2.0 * kFarthest) {
    return selection;
  }
  const Eigen::Vector3i first = (box.min() / side).array().floor().cast<int>();
  const Eigen::Vector3i last = (box.max() / side).array().floor().cast<int>();
  BlockIndex index;
  for (index.x = first.x(); index.x <= last.x(); ++index.x) {
    for (index.y = first.y(); index.y <= last.y(); ++index.y) {
      const auto [lowest, highest] = levels_inside(frustum, index, side);
      index.z = std::max(first.z(), lowest);
      for (const int end = std::min(last.z(), highest); index.z <= end; ++index.z) {
        ++selection.blocks_visited;
        const auto found = blocks_.find(index);
        if (found == blocks_.end() || !frustum.may_intersect(block_box(index))) continue;
        ++selection.blocks_used;
        append_surfels(index, found->second, selection.surfels);
      }
    }
  }
  return selection;
}

void VoxelMap::append_surfels(const BlockIndex& index, const MapBlock& block,
                              std::vector<Surfel>& surfels) const {
  constexpr double kLeastLength = kLeastAgreement * MapVoxel::kNormalUnit;
  block.for_each([&](int number, const MapVoxel& voxel) {
    const Eigen::Vector3d normal(voxel.normal[0], voxel.normal[1], voxel.normal[2]);
    const double n = voxel.count, squared = normal.squaredNorm();
    if (squared < kLeastLength * kLeastLength * n * n) return;
    const Eigen::Vector3d mean = voxel.first_moment().array() / n + 0.5;  // as to_point()
    surfels.push_back(
        {voxel_center(index, number) + mean / fine_per_metre_, normal / std::sqrt(squared)});
  });
}

}  // namespace geomap::perception
