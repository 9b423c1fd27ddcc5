// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <set>
#include <vector>

#include "geometry/planar_polygon.hpp"
#include "mapping/view_feature.hpp"

namespace geomap::viewer {

/// @brief What the operator points at and has chosen, and what he is about to do: what renderers
/// mark.
struct Selection {
  std::set<mapping::FeatureId> selected;
  std::optional<mapping::FeatureId> hovered;

  /// A motion that is being tried or waits for the mapper: the features are drawn moved, and a
  /// ghost stays at the old place.
  struct Motion {
    std::set<mapping::FeatureId> targets;
    Eigen::Isometry3d T_world_moved = Eigen::Isometry3d::Identity();
    bool operator==(const Motion& other) const {
      return targets == other.targets && T_world_moved.matrix() == other.T_world_moved.matrix();
    }
  };
  std::vector<Motion> motions;
  /// Features that wait for the mapper to delete, merge or cut them: drawn as ghosts.
  std::set<mapping::FeatureId> pending;

  bool operator==(const Selection&) const = default;
};

}  // namespace geomap::viewer
