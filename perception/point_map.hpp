// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "geometry/depth_correction.hpp"
#include "geometry/rgbd_frame.hpp"
#include "perception/surface_image.hpp"
#include "perception/voxel_map.hpp"

namespace geomap::perception {

struct PointMapConfig {
  VoxelMapConfig voxels;
  int max_keyframe_bytes = 40'000;  // what is kept of a key frame, see thin_frame()

  std::vector<std::string> validate() const;

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& visitor) {
    VoxelMapConfig::visit(self.voxels, visitor);
    visitor("max_keyframe_bytes", self.max_keyframe_bytes);
  }
};

/// @brief A frame as the point map and the registration take it: thinned, depth corrected, surfaces
/// found.
struct FrameView {
  geometry::RgbdFrame thin;  // depth as it was read
  geometry::RgbdFrame corrected;
  SurfaceImage surfaces;  // of the corrected frame
};

/// @brief What the robot has seen: a fold over key frames. Of each one a thin frame is kept, and
/// the voxels hold exactly the readings of the thin frames at their poses, each with the depth
/// correction that it has. So a key frame can be
/// dropped or moved at any time, at the cost of that key frame alone, and the map is the same to
/// the last bit as if it had been built so from the start, in any order.
class PointMap {
 public:
  /// @throws std::invalid_argument when the configuration is not valid.
  explicit PointMap(const PointMapConfig& config = {});

  /// @brief The frame as it would enter the map now.
  /// @throws std::invalid_argument when sizes of images and cameras disagree.
  FrameView view(const geometry::RgbdFrame& frame) const;

  /// @brief Adds a view of now. @param keyframe its id, the frame's utime [us].
  /// @throws std::invalid_argument for an id that is in the map, and as VoxelMap::insert(); the map
  /// is then as before.
  void insert(std::int64_t keyframe, const FrameView& view,
              const Eigen::Isometry3d& T_world_camera);
  void insert(std::int64_t keyframe, const geometry::RgbdFrame& frame,
              const Eigen::Isometry3d& T_world_camera) {
    insert(keyframe, view(frame), T_world_camera);
  }

  /// @return false when there is no such key frame.
  bool remove(std::int64_t keyframe);

  /// @brief Gives a key frame another pose. @return false when there is no such key frame.
  /// @throws std::invalid_argument for a pose that is not rigid or out of range; nothing is moved.
  bool move(std::int64_t keyframe, const Eigen::Isometry3d& T_world_camera);

  /// @brief Another correction of depth from here on. Key frames in the map keep the one they have
  /// until refresh().
  void set_depth_correction(const geometry::DepthCorrection& correction);
  const geometry::DepthCorrection& depth_correction() const {
    return revisions_.at(revision_).correction;
  }

  /// @brief Gives up to `count` key frames the present correction, those first whose own is
  /// farthest from it; of equals, the newest. @param least_change of the correction somewhere in
  /// the image, as a share of the depth, below which a key frame stays as it is.
  /// @return how many were changed. After refresh(keyframes(), 0) the map is as if the correction
  /// had always been this one.
  std::size_t refresh(std::size_t count, double least_change);

  void clear();  // key frames; the correction stays, it is the camera's

  /// @brief A key frame as it is in the map, and its pose; nothing when there is no such key frame.
  std::optional<FrameView> view_of(std::int64_t keyframe) const;
  std::optional<Eigen::Isometry3d> pose_of(std::int64_t keyframe) const;

  /// @brief What is kept of a key frame; nullptr when there is no such key frame.
  const geometry::RgbdFrame* thin_frame_of(std::int64_t keyframe) const;

  const VoxelMap& voxels() const { return voxels_; }
  std::vector<BlockIndex> take_changed_blocks() { return voxels_.take_changed_blocks(); }
  std::vector<MapPoint> points() const { return voxels_.points(); }
  std::size_t size() const { return voxels_.size(); }  // points
  std::size_t keyframes() const { return kept_.size(); }
  std::size_t memory_bytes() const;  // voxels and the images of thin frames

 private:
  struct Kept {
    geometry::RgbdFrame frame;
    Eigen::Isometry3d T_world_camera;
    std::int64_t revision;  // of the correction with which it is in the voxels
  };
  // A correction and the key frames that have it.
  struct Revision {
    geometry::DepthCorrection correction;
    std::set<std::int64_t> keyframes = {};
    double change = 0.0;  // to the present one, largest in the image
  };

  FrameView view_of_thin(const geometry::RgbdFrame& thin, std::int64_t revision) const;
  std::optional<std::int64_t> most_outdated(double least_change) const;
  void forget_revision(std::int64_t keyframe, std::int64_t revision);

  PointMapConfig config_;
  VoxelMap voxels_;
  std::map<std::int64_t, Kept> kept_;  // by id
  std::int64_t revision_ = 0;          // the present one, of which there is always an entry
  std::map<std::int64_t, Revision> revisions_ = {{0, {}}};
};

}  // namespace geomap::perception
