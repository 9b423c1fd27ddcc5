// SPDX-License-Identifier: BSD-3-Clause
#include "perception/keyframe_selector.hpp"

#include <cmath>
#include <stdexcept>

#include "geometry/angles.hpp"
#include "perception/rigid_transform.hpp"

namespace geomap::perception {

std::vector<std::string> KeyframeConfig::validate() const {
  std::vector<std::string> errors;
  if (!(min_translation >= 0.0) || !std::isfinite(min_translation)) {
    errors.push_back("min_translation must be at least 0 m");
  }
  if (!(min_rotation_deg >= 0.0) || !(min_rotation_deg <= 180.0)) {
    errors.push_back("min_rotation_deg must lie between 0 and 180");
  }
  return errors;
}

KeyframeSelector::KeyframeSelector(const KeyframeConfig& config) : config_(config) {
  const auto errors = config.validate();
  if (!errors.empty()) throw std::invalid_argument("keyframe: " + errors.front());
}

bool KeyframeSelector::is_due(const Eigen::Isometry3d& T_world_camera) const {
  if (!last_) return true;
  const double moved = (T_world_camera.translation() - last_->translation()).norm();
  const double turned_deg = geometry::degrees(angle_between(*last_, T_world_camera));
  return moved >= config_.min_translation || turned_deg >= config_.min_rotation_deg;
}

void KeyframeSelector::accept(const Eigen::Isometry3d& T_world_camera) { last_ = T_world_camera; }

}  // namespace geomap::perception
