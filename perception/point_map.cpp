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
  return view_of_thin(thin_frame(frame, colored ? max_bytes : max_bytes * 2 / 5), revision_);
}

FrameView PointMap::view_of_thin(const geometry::RgbdFrame& thin, std::int64_t revision) const {
  geometry::RgbdFrame better = corrected(thin, revisions_.at(revision).correction);
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
  kept_.emplace(keyframe, Kept{view.thin, T_world_camera, revision_});
  revisions_.at(revision_).keyframes.insert(keyframe);
}

bool PointMap::remove(std::int64_t keyframe) {
  const auto found = kept_.find(keyframe);
  if (found == kept_.end()) return false;
  const FrameView view = view_of_thin(found->second.frame, found->second.revision);
  voxels_.remove(view.corrected, found->second.T_world_camera, &view.surfaces);
  forget_revision(keyframe, found->second.revision);
  kept_.erase(found);
  return true;
}

bool PointMap::move(std::int64_t keyframe, const Eigen::Isometry3d& T_world_camera) {
  const auto found = kept_.find(keyframe);
  if (found == kept_.end()) return false;
  Kept& kept = found->second;
  const FrameView view = view_of_thin(kept.frame, kept.revision);
  voxels_.insert(view.corrected, T_world_camera,
                 &view.surfaces);  // first: it is this that may throw
  voxels_.remove(view.corrected, kept.T_world_camera, &view.surfaces);
  kept.T_world_camera = T_world_camera;
  return true;
}

void PointMap::set_depth_correction(const geometry::DepthCorrection& correction) {
  if (revisions_.at(revision_).keyframes.empty()) revisions_.erase(revision_);
  for (auto& [number, revision] : revisions_) {
    const geometry::CameraModel& camera = kept_.at(*revision.keyframes.begin()).frame.depth_camera;
    revision.change =
        geometry::DepthCorrection::largest_difference(revision.correction, correction, camera);
  }
  revisions_.emplace(++revision_, Revision{correction});
}

std::size_t PointMap::refresh(std::size_t count, double least_change) {
  for (std::size_t done = 0; done < count; ++done) {
    const auto keyframe = most_outdated(least_change);
    if (!keyframe) return done;
    Kept& kept = kept_.at(*keyframe);
    const FrameView before = view_of_thin(kept.frame, kept.revision);
    const FrameView now = view_of_thin(kept.frame, revision_);
    voxels_.insert(now.corrected, kept.T_world_camera, &now.surfaces);
    voxels_.remove(before.corrected, kept.T_world_camera, &before.surfaces);
    forget_revision(*keyframe, kept.revision);
    kept.revision = revision_;
    revisions_.at(revision_).keyframes.insert(*keyframe);
  }
  return count;
}

std::optional<std::int64_t> PointMap::most_outdated(double least_change) const {
  const Revision* most = nullptr;
  for (const auto& [number, revision] : revisions_) {
    const bool is_due = revision.change > 0.0 && revision.change >= least_change;
    if (is_due && (most == nullptr || revision.change >= most->change)) most = &revision;
  }
  if (most == nullptr) return std::nullopt;
  return *most->keyframes.rbegin();
}

void PointMap::forget_revision(std::int64_t keyframe, std::int64_t revision) {
  const auto found = revisions_.find(revision);
  found->second.keyframes.erase(keyframe);
  if (found->second.keyframes.empty() && revision != revision_) revisions_.erase(found);
}

std::optional<FrameView> PointMap::view_of(std::int64_t keyframe) const {
  const auto found = kept_.find(keyframe);
  if (found == kept_.end()) return std::nullopt;
  return view_of_thin(found->second.frame, found->second.revision);
}

std::optional<Eigen::Isometry3d> PointMap::pose_of(std::int64_t keyframe) const {
  const auto found = kept_.find(keyframe);
  if (found == kept_.end()) return std::nullopt;
  return found->second.T_world_camera;
}

const geometry::RgbdFrame* PointMap::thin_frame_of(std::int64_t keyframe) const {
  const auto found = kept_.find(keyframe);
  return found == kept_.end() ? nullptr : &found->second.frame;
}

void PointMap::clear() {
  voxels_.clear();
  kept_.clear();
  std::erase_if(revisions_, [this](const auto& entry) { return entry.first != revision_; });
  revisions_.at(revision_).keyframes.clear();
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
