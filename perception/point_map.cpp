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

void PointMap::insert(std::int64_t keyframe, const geometry::RgbdFrame& frame,
                      const Eigen::Isometry3d& T_world_camera) {
  if (kept_.contains(keyframe)) {
    throw std::invalid_argument("point map: key frame " + std::to_string(keyframe) +
                                " is in the map already");
  }
  const auto max_bytes = static_cast<std::size_t>(config_.max_keyframe_bytes);
  Kept kept{thin_frame(frame, max_bytes), T_world_camera};
  voxels_.insert(kept.frame, T_world_camera);
  kept_.emplace(keyframe, std::move(kept));
}

bool PointMap::remove(std::int64_t keyframe) {
  const auto found = kept_.find(keyframe);
  if (found == kept_.end()) return false;
  voxels_.remove(found->second.frame, found->second.T_world_camera);
  kept_.erase(found);
  return true;
}

bool PointMap::move(std::int64_t keyframe, const Eigen::Isometry3d& T_world_camera) {
  const auto found = kept_.find(keyframe);
  if (found == kept_.end()) return false;
  Kept& kept = found->second;
  voxels_.insert(kept.frame, T_world_camera);  // first: it is this that may throw
  voxels_.remove(kept.frame, kept.T_world_camera);
  kept.T_world_camera = T_world_camera;
  return true;
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
