// SPDX-License-Identifier: BSD-3-Clause
#include "perception/point_map.hpp"

#include <stdexcept>
#include <utility>

#include "perception/thin_frame.hpp"

namespace geomap::perception {
namespace {

const PointMapConfig& validated(const PointMapConfig& config) {
  const auto errors = config.validate();
  if (!errors.empty()) throw std::invalid_argument("point map: " + errors.front());
  return config;
}

}  // namespace

std::vector<std::string> PointMapConfig::validate() const {
  std::vector<std::string> errors = voxels.validate();
  if (max_keyframe_bytes < 1000) errors.push_back("max_keyframe_bytes must be at least 1000");
  return errors;
}

PointMap::PointMap(const PointMapConfig& config)
    : config_(validated(config)), voxels_(config.voxels) {}

// As many pixels are kept of a frame without colour, which registration must not depend on.
FrameView PointMap::view(const geometry::RgbdFrame& frame) const {
  const auto max_bytes = static_cast<std::size_t>(config_.max_keyframe_bytes);
  const bool colored =
      frame.color.width == frame.depth.width && frame.color.height == frame.depth.height;
  return view_of_thin(thin_frame(frame, colored ? max_bytes : max_bytes * 2 / 5));
}

FrameView PointMap::view_of_thin(const geometry::RgbdFrame& thin) const {
  geometry::RgbdFrame better = corrected(thin, correction_);
  SurfaceImage surfaces(better, config_.voxels.min_depth, config_.voxels.max_depth);
  return {thin, std::move(better), std::move(surfaces)};
}

void PointMap::insert(std::int64_t keyframe, const FrameView& view,
                      const Eigen::Isometry3d& T_world_camera) {
  if (kept_.contains(keyframe)) {
    throw std::invalid_argument("point map: key frame " + std::to_string(keyframe) +
                                " is in the map already");
  }
  voxels_.insert(view.corrected, T_world_camera, &view.surfaces);
  kept_.emplace(keyframe, Kept{view.thin, T_world_camera});
}

bool PointMap::remove(std::int64_t keyframe) {
  const auto found = kept_.find(keyframe);
  if (found == kept_.end()) return false;
  const FrameView view = view_of_thin(found->second.frame);
  voxels_.remove(view.corrected, found->second.T_world_camera, &view.surfaces);
  kept_.erase(found);
  return true;
}

bool PointMap::move(std::int64_t keyframe, const Eigen::Isometry3d& T_world_camera) {
  const auto found = kept_.find(keyframe);
  if (found == kept_.end()) return false;
  Kept& kept = found->second;
  const FrameView view = view_of_thin(kept.frame);
  voxels_.insert(view.corrected, T_world_camera,
                 &view.surfaces);  // first: it is this that may throw
  voxels_.remove(view.corrected, kept.T_world_camera, &view.surfaces);
  kept.T_world_camera = T_world_camera;
  return true;
}

void PointMap::set_depth_correction(const DepthCorrection& correction) {
  correction_ = correction;
  voxels_.clear();
  for (const auto& [keyframe, kept] : kept_) {
    const FrameView view = view_of_thin(kept.frame);
    voxels_.insert(view.corrected, kept.T_world_camera, &view.surfaces);
  }
}

std::optional<FrameView> PointMap::view_of(std::int64_t keyframe) const {
  const auto found = kept_.find(keyframe);
  if (found == kept_.end()) return std::nullopt;
  return view_of_thin(found->second.frame);
}

std::optional<Eigen::Isometry3d> PointMap::pose_of(std::int64_t keyframe) const {
  const auto found = kept_.find(keyframe);
  if (found == kept_.end()) return std::nullopt;
  return found->second.T_world_camera;
}

void PointMap::clear() {
  voxels_.clear();
  kept_.clear();
}

std::size_t PointMap::memory_bytes() const {
  std::size_t bytes = voxels_.memory_bytes();
  for (const auto& [keyframe, kept] : kept_) {
    bytes +=
        kept.frame.depth.millimetres.size() * sizeof(std::uint16_t) + kept.frame.color.rgb.size();
  }
  return bytes;
}

}  // namespace geomap::perception
