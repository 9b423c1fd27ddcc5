// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "geometry/frustum.hpp"
#include "geometry/rgbd_frame.hpp"
#include "perception/map_voxel.hpp"
#include "perception/surface_image.hpp"
#include "perception/surfel.hpp"

namespace geomap::perception {

struct VoxelMapConfig {
  double voxel_size = 0.03;  // [m]
  double min_depth = 0.4;    // readings nearer than this are left out [m]
  double max_depth = 5.0;    // readings farther than this are left out [m]

  std::vector<std::string> validate() const;

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& visitor) {
    visitor("voxel_size", self.voxel_size);
    visitor("min_depth", self.min_depth);
    visitor("max_depth", self.max_depth);
  }
};

/// @brief One voxel of the map as a point: the mean of what was measured in it. World frame.
struct MapPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();    // [m]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // of the readings about the mean [m²]
  std::int64_t readings = 0;
  std::array<std::uint8_t, 3> color = {128, 128, 128};  // red, green, blue; grey where none seen
};

/// @brief The map's surface inside a frustum, and what finding it took.
struct SurfelSelection {
  std::vector<Surfel> surfels;  // ordered by block and voxel
  int blocks_visited = 0;       // looked up: those between the frustum's sides
  int blocks_used = 0;          // that hold points and may lie inside the frustum
};

/// @brief What the robot has seen, as moments of points in voxels, in blocks of 8 x 8 x 8 voxels
/// found through a hash table.
///
/// Its sums are integers (positions in 1/4096 of a voxel, relative to the voxel's centre), so
/// adding is exact: the order of frames does not matter, and remove() is the exact inverse of
/// insert().
///
/// Memory: 112 bytes for a voxel that holds points, and 1 kB for each block, in all about 133 bytes
/// a voxel (recorded kitchen, voxels of 2 to 4 cm). Precision is the same at any distance from the
/// origin up to 1000 km.
class VoxelMap {
 public:
  static constexpr double kFarthest = 1e6;  // of a camera from the origin, along an axis [m]

  /// @throws std::invalid_argument when the configuration is not valid.
  explicit VoxelMap(const VoxelMapConfig& config = {});

  /// @brief Adds every reading of the frame between min_depth and max_depth, usually of a
  /// thin_frame(). @param surfaces of the frame, whose normals are added too; may be null.
  /// @return the number of readings added.
  /// @throws std::invalid_argument for an invalid camera, image sizes that disagree, or a pose that
  /// is not rigid or farther than 1000 km from the origin.
  std::size_t insert(const geometry::RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera,
                     const SurfaceImage* surfaces = nullptr);

  /// @brief Takes away what insert() added for the same frame, pose and surfaces.
  /// @throws std::invalid_argument as above, and when a reading was not in the map (which is then
  /// without the readings before it).
  std::size_t remove(const geometry::RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera,
                     const SurfaceImage* surfaces = nullptr);

  /// @brief All points, ordered by block and voxel: the same for the same content of the map.
  std::vector<MapPoint> points() const;

  /// @brief The voxel that contains a point of the world, where it holds anything.
  std::optional<MapPoint> at(const Eigen::Vector3d& p_world) const;

  /// @brief Surfels of the voxels in blocks that may lie inside the frustum. Its cost is that of
  /// the frustum's size and content, whatever else the map holds. Voxels whose readings have no
  /// common normal (edges, clutter) are left out.
  SurfelSelection surfels_in(const geometry::Frustum& frustum) const;

  /// @brief Blocks that hold anything, ascending.
  std::vector<BlockIndex> blocks() const;
  Eigen::AlignedBox3d block_box(const BlockIndex& index) const;  // world frame [m]
  std::vector<MapPoint> block_points(const BlockIndex& index) const;

  /// @brief Blocks that were changed, filled or emptied since the last call, ascending.
  std::vector<BlockIndex> take_changed_blocks();

  std::size_t size() const { return voxels_; }  // voxels that hold points
  std::size_t memory_bytes() const;             // of blocks and voxels, without spare capacity
  void clear();

 private:
  template <typename Action>
  std::size_t for_each_reading(const geometry::RgbdFrame& frame,
                               const Eigen::Isometry3d& T_world_camera,
                               const SurfaceImage* surfaces, Action action) const;
  void append_surfels(const BlockIndex& index, const MapBlock& block,
                      std::vector<Surfel>& surfels) const;
  Eigen::Vector3d voxel_center(const BlockIndex& index, int number) const;
  MapPoint point_of(const BlockIndex& index, int number, const MapVoxel& voxel) const;
  void append_points(const BlockIndex& index, const MapBlock& block,
                     std::vector<MapPoint>& points) const;

  VoxelMapConfig config_;
  double fine_per_metre_;
  std::unordered_map<BlockIndex, MapBlock, BlockIndexHash> blocks_;
  std::size_t voxels_ = 0;
  std::unordered_set<BlockIndex, BlockIndexHash> changed_;
};

}  // namespace geomap::perception
