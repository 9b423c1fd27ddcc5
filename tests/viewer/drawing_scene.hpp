// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "viewer/scene_model.hpp"
#include "viewer/view_camera.hpp"

namespace geomap::testing {

/// @brief Numbers of the features of drawing_scene(), their FeatureId::plane.
enum DrawnFeature {
  kFloor,
  kWestWall,
  kEastWall,
  kSouthWall,
  kNorthWall,
  kCeiling,
  kTable,
  kCupboard,
  kRamp
};
mapping::FeatureId drawn_id(DrawnFeature feature);

/// @brief A kitchen of 5 x 4 x 2.5 m: floor, walls (one with a window), ceiling, a table with a
/// hole, the front of a cupboard that is held, an inclined board; a point map of some 11 000
/// points, a path, a key frame and a camera frame. The same on every machine.
/// @param corner where the room's south-western lower corner is, world frame [m].
viewer::SceneModel drawing_scene(const Eigen::Vector3d& corner = Eigen::Vector3d::Zero());

/// @brief Three ways to look at it: from above its south-western corner, straight down, and near.
viewer::ViewCamera oblique_view(const Eigen::Vector3d& corner = Eigen::Vector3d::Zero());
viewer::ViewCamera top_view();
viewer::ViewCamera near_view();

}  // namespace geomap::testing
