// SPDX-License-Identifier: BSD-3-Clause
#include "perception/voxel_map.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "perception/rigid_transform.hpp"
#include "perception/voxel_rows.hpp"

namespace geomap::perception {
namespace {

using geometry::DepthImage;
using geometry::RgbdFrame;
using Fine = std::array<std::int64_t, 3>;  // a point in 1/4096 voxel

std::size_t pixels_of(int width, int height) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

void check(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera,
           const SurfaceImage* surfaces) {
  const DepthImage& depth = frame.depth;
  if (!frame.depth_camera.valid() || depth.width != frame.depth_camera.width ||
      depth.height != frame.depth_camera.height ||
      depth.millimetres.size() != pixels_of(depth.width, depth.height)) {
    throw std::invalid_argument("voxel map: depth image and camera disagree");
  }
  if (!frame.color.empty() &&
      frame.color.rgb.size() != 3 * pixels_of(frame.color.width, frame.color.height)) {
    throw std::invalid_argument("voxel map: colour image has the wrong number of bytes");
  }
  if (surfaces != nullptr && !(surfaces->camera() == frame.depth_camera)) {
    throw std::invalid_argument("voxel map: the surfaces are those of another camera");
  }
  if (!is_rigid(T_world_camera) ||
      T_world_camera.translation().cwiseAbs().maxCoeff() > VoxelMap::kFarthest) {
    throw std::invalid_argument("voxel map: T_world_camera is not rigid or out of range");
  }
}

Fine to_fine(const Eigen::Vector3d& p) {
  return {static_cast<std::int64_t>(std::floor(p.x())),
          static_cast<std::int64_t>(std::floor(p.y())),
          static_cast<std::int64_t>(std::floor(p.z()))};
}

std::array<std::int32_t, 3> to_fixed(const Eigen::Vector3d& normal) {
  const auto rounded = [](double value) {
    return static_cast<std::int32_t>(value + (value < 0.0 ? -0.5 : 0.5));
  };
  const Eigen::Vector3d fixed = MapVoxel::kNormalUnit * normal;
  return {rounded(fixed.x()), rounded(fixed.y()), rounded(fixed.z())};
}

MapPoint to_point(const MapVoxel& voxel, const Eigen::Vector3d& center, double metres_per_fine) {
  const double n = voxel.count;
  // A fine coordinate is rounded down: what was measured lies half a step higher on average.
  const Eigen::Vector3d mean = voxel.first_moment() / n;
  MapPoint point;
  point.position = center + metres_per_fine * (mean.array() + 0.5).matrix();
  for (int i = 0, k = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j, ++k) {
      const double second = static_cast<double>(voxel.second[static_cast<std::size_t>(k)]) / n;
      point.covariance(i, j) = point.covariance(j, i) =
          metres_per_fine * metres_per_fine * (second - mean(i) * mean(j));
    }
  }
  point.readings = voxel.count;
  for (std::size_t c = 0; voxel.colored > 0 && c < 3; ++c) {
    point.color[c] =
        static_cast<std::uint8_t>((voxel.color[c] + voxel.colored / 2) / voxel.colored);
  }
  return point;
}

}  // namespace

std::vector<std::string> VoxelMapConfig::validate() const {
  std::vector<std::string> errors;
  if (!(voxel_size >= 0.01) || !(voxel_size <= 1.0)) {
    errors.push_back("voxel_size must lie between 0.01 and 1 m");
  }
  if (!(min_depth >= 0.0) || !(max_depth > min_depth) || !(max_depth <= 65.0)) {
    errors.push_back("depths must obey 0 <= min_depth < max_depth <= 65 m");
  }
  return errors;
}

VoxelMap::VoxelMap(const VoxelMapConfig& config)
    : config_(config), fine_per_metre_(static_cast<double>(MapVoxel::kFine) / config.voxel_size) {
  const auto errors = config.validate();
  if (!errors.empty()) throw std::invalid_argument("voxel map: " + errors.front());
}

template <typename Action>
std::size_t VoxelMap::for_each_reading(const RgbdFrame& frame,
                                       const Eigen::Isometry3d& T_world_camera,
                                       const SurfaceImage* surfaces, Action action) const {
  check(frame, T_world_camera, surfaces);
  const auto& camera = frame.depth_camera;
  const bool colored =
      frame.color.width == frame.depth.width && frame.color.height == frame.depth.height;
  // All places are in fine units, those of a row from a whole number of them near the camera.
  const Eigen::Matrix3d rotation = fine_per_metre_ * 1e-3 * T_world_camera.linear();
  const Eigen::Vector3d origin = fine_per_metre_ * T_world_camera.translation();
  const Fine near_origin = to_fine(origin);
  const Eigen::Vector3d step = rotation.col(0) / camera.fx;
  VoxelRow row{
      {}, {}, {step.x(), step.y(), step.z()}, config_.min_depth * 1e3, config_.max_depth * 1e3};
  for (std::size_t i = 0; i < 3; ++i) {
    row.origin[i] = origin(static_cast<Eigen::Index>(i)) - static_cast<double>(near_origin[i]);
  }
  const std::size_t width = pixels_of(camera.width, 1);
  std::vector<std::int32_t> places(3 * width);
  std::vector<std::uint8_t> counts(width);
  const std::array<std::int32_t*, 3> place = {places.data(), places.data() + width,
                                              places.data() + 2 * width};
  std::size_t readings = 0;
  for (int v = 0; v < camera.height; ++v) {
    const Eigen::Vector3d ray = rotation * camera.ray(0.0, v);
    row.ray = {ray.x(), ray.y(), ray.z()};
    const std::size_t row_start = pixels_of(camera.width, v);
    place_readings(row, frame.depth.millimetres.data() + row_start, camera.width, place,
                   counts.data());
    for (std::size_t u = 0; u < width; ++u) {
      if (counts[u] == 0) continue;
      VoxelReading contribution;
      if (colored) contribution.rgb = &frame.color.rgb[3 * (row_start + u)];
      if (surfaces != nullptr) {
        const SurfacePixel& surface = surfaces->pixels()[row_start + u];
        if (surface.valid()) {
          contribution.normal = to_fixed(T_world_camera.linear() * surface.normal);
        }
      }
      const VoxelAddress address =
          VoxelAddress::of({near_origin[0] + place[0][u], near_origin[1] + place[1][u],
                            near_origin[2] + place[2][u]});
      contribution.offset = address.offset;
      action(address, contribution);
      ++readings;
    }
  }
  return readings;
}

std::size_t VoxelMap::insert(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera,
                             const SurfaceImage* surfaces) {
  MapBlock* block = nullptr;  // of the last reading: the next one is mostly in the same
  BlockIndex index;
  const auto add = [&](const VoxelAddress& address, const VoxelReading& reading) {
    if (block == nullptr || address.block != index) {
      index = address.block;
      block = &blocks_[index];  // stays where it is when the table grows
      changed_.insert(index);
    }
    MapVoxel& voxel = block->find_or_add(address.number);
    if (voxel.count == 0) ++voxels_;
    reading.apply<1>(voxel);
  };
  return for_each_reading(frame, T_world_camera, surfaces, add);
}

std::size_t VoxelMap::remove(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera,
                             const SurfaceImage* surfaces) {
  std::optional<BlockIndex> last;  // noted as changed: the next reading is mostly in the same
  const auto take_away = [&](const VoxelAddress& address, const VoxelReading& reading) {
    const auto found = blocks_.find(address.block);
    MapVoxel* voxel = found == blocks_.end() ? nullptr : found->second.find(address.number);
    if (voxel == nullptr || (reading.rgb != nullptr && voxel->colored == 0)) {
      throw std::invalid_argument("voxel map: the frame to remove was not inserted");
    }
    reading.apply<-1>(*voxel);
    if (last != address.block) changed_.insert(*(last = address.block));
    if (voxel->count > 0) return;
    found->second.erase(address.number);
    --voxels_;
    if (found->second.size() == 0) blocks_.erase(found);
  };
  return for_each_reading(frame, T_world_camera, surfaces, take_away);
}

std::vector<BlockIndex> VoxelMap::blocks() const {
  std::vector<BlockIndex> indices;
  indices.reserve(blocks_.size());
  for (const auto& entry : blocks_) indices.push_back(entry.first);
  std::sort(indices.begin(), indices.end());  // the table's own order means nothing
  return indices;
}

std::vector<BlockIndex> VoxelMap::take_changed_blocks() {
  std::vector<BlockIndex> indices(changed_.begin(), changed_.end());
  changed_.clear();
  std::sort(indices.begin(), indices.end());
  return indices;
}

Eigen::AlignedBox3d VoxelMap::block_box(const BlockIndex& index) const {
  const double side = config_.voxel_size * MapBlock::kSide;
  const Eigen::Vector3d corner = side * Eigen::Vector3d(index.x, index.y, index.z);
  return {corner, corner + Eigen::Vector3d::Constant(side)};
}

Eigen::Vector3d VoxelMap::voxel_center(const BlockIndex& index, int number) const {
  constexpr int kMask = MapBlock::kSide - 1;
  const Eigen::Vector3d cell(number >> (2 * MapBlock::kSideBits),
                             (number >> MapBlock::kSideBits) & kMask, number & kMask);
  return block_box(index).min() + config_.voxel_size * (cell.array() + 0.5).matrix();
}

MapPoint VoxelMap::point_of(const BlockIndex& index, int number, const MapVoxel& voxel) const {
  return to_point(voxel, voxel_center(index, number), 1.0 / fine_per_metre_);
}

void VoxelMap::append_points(const BlockIndex& index, const MapBlock& block,
                             std::vector<MapPoint>& points) const {
  block.for_each(
      [&](int number, const MapVoxel& voxel) { points.push_back(point_of(index, number, voxel)); });
}

std::optional<MapPoint> VoxelMap::at(const Eigen::Vector3d& p_world) const {
  if (!p_world.allFinite() || p_world.cwiseAbs().maxCoeff() > 2.0 * kFarthest) return std::nullopt;
  const VoxelAddress address = VoxelAddress::of(to_fine(fine_per_metre_ * p_world));
  const auto found = blocks_.find(address.block);
  const MapVoxel* voxel = found == blocks_.end() ? nullptr : found->second.find(address.number);
  if (voxel == nullptr) return std::nullopt;
  return point_of(address.block, address.number, *voxel);
}

std::vector<MapPoint> VoxelMap::block_points(const BlockIndex& index) const {
  std::vector<MapPoint> points;
  const auto found = blocks_.find(index);
  if (found != blocks_.end()) append_points(index, found->second, points);
  return points;
}

std::vector<MapPoint> VoxelMap::points() const {
  std::vector<MapPoint> points;
  points.reserve(voxels_);
  for (const BlockIndex& index : blocks()) append_points(index, blocks_.at(index), points);
  return points;
}

std::size_t VoxelMap::memory_bytes() const {
  return blocks_.size() * (sizeof(BlockIndex) + sizeof(MapBlock)) +
         voxels_ * (sizeof(MapVoxel) + sizeof(std::uint16_t));
}

void VoxelMap::clear() {
  for (const auto& entry : blocks_) changed_.insert(entry.first);
  blocks_.clear();
  voxels_ = 0;
}

}  // namespace geomap::perception
