// SPDX-License-Identifier: BSD-3-Clause
#include "perception/voxel_cloud.hpp"

#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace geomap::perception {
namespace {

// Normals of one voxel whose mean is shorter than this (a crease of about 50°) are of no use.
constexpr double kLeastAgreement = 0.9;

std::uint64_t voxel_key(const Eigen::Vector3d& point, double leaf) {
  constexpr std::int64_t kOffset = 1 << 20;
  std::uint64_t key = 0;
  for (const double coordinate : {point.x(), point.y(), point.z()}) {
    const auto step = static_cast<std::int64_t>(std::floor(coordinate / leaf)) + kOffset;
    key = (key << 21) | (static_cast<std::uint64_t>(step) & 0x1fffff);
  }
  return key;
}

}  // namespace

Eigen::Vector3d evenly_dense(const Eigen::Vector3d& point, double reference) {
  if (point.z() <= reference) return point;
  const double shrink = reference / point.z();
  return {point.x() * shrink, point.y() * shrink,
          reference * (1.0 + std::log(point.z() / reference))};
}

VoxelCloud make_voxel_cloud(const DepthCells& cells, const std::vector<CellNormal>& normals,
                            double leaf, double reference) {
  VoxelCloud cloud;
  cloud.voxel_of_cell.assign(static_cast<std::size_t>(cells.size()), -1);
  // Looked up, never walked: the voxels' order is that of the cells.
  std::unordered_map<std::uint64_t, int> voxel_at;
  voxel_at.reserve(static_cast<std::size_t>(cells.size()));
  for (int i = 0; i < cells.size(); ++i) {
    const CellNormal& normal = normals[static_cast<std::size_t>(i)];
    if (normal.kind != CellNormal::Kind::kPlanar) continue;
    const InverseDepthSums cell = cells.cell(i);
    const Eigen::Vector3d point = cell.mean_point();
    const auto [at, is_new] = voxel_at.try_emplace(voxel_key(evenly_dense(point, reference), leaf),
                                                   static_cast<int>(cloud.voxels.size()));
    if (is_new) cloud.voxels.emplace_back();
    Voxel& voxel = cloud.voxels[static_cast<std::size_t>(at->second)];
    voxel.mean += cell.count * point;
    voxel.normal += cell.count * normal.normal;
    voxel.pixels += cell.count;
    cloud.voxel_of_cell[static_cast<std::size_t>(i)] = at->second;
  }

  std::vector<int> kept(cloud.voxels.size(), -1);
  std::vector<Voxel> agreeing;
  agreeing.reserve(cloud.voxels.size());
  for (std::size_t i = 0; i < cloud.voxels.size(); ++i) {
    Voxel voxel = cloud.voxels[i];
    const double length = voxel.normal.norm();
    if (length < kLeastAgreement * voxel.pixels) continue;
    voxel.mean /= voxel.pixels;
    voxel.normal /= length;
    kept[i] = static_cast<int>(agreeing.size());
    agreeing.push_back(voxel);
  }
  for (int& voxel : cloud.voxel_of_cell) {
    if (voxel >= 0) voxel = kept[static_cast<std::size_t>(voxel)];
  }
  cloud.voxels = std::move(agreeing);
  return cloud;
}

}  // namespace geomap::perception
