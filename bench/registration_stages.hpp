// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "geometry/frustum.hpp"
#include "perception/point_map.hpp"

namespace geomap::bench {

/// @brief What IcpRegistration::align() takes out of the map, so that it can be timed alone.
inline perception::SurfelSelection select_surfels(const perception::VoxelMap& map,
                                                  const perception::FrameView& view,
                                                  const Eigen::Isometry3d& T_world_camera_prior,
                                                  double margin) {
  const Eigen::Isometry3d behind =
      T_world_camera_prior * Eigen::Translation3d(0.0, 0.0, -2.0 * margin);
  return map.surfels_in(
      {view.thin.depth_camera, 0.1, view.surfaces.farthest() + 3.0 * margin, behind});
}

}  // namespace geomap::bench
