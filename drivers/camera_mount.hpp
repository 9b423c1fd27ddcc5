// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

namespace geomap::drivers {

/// @brief T_body_camera of a camera held upright that looks straight ahead from the body's origin:
/// turns optical axes (x right, y down, z forward) into the body's (x forward, y left, z up).
inline Eigen::Isometry3d forward_camera_mount() {
  Eigen::Isometry3d T_body_camera = Eigen::Isometry3d::Identity();
  T_body_camera.linear() << 0.0, 0.0, 1.0,  //
      -1.0, 0.0, 0.0,                       //
      0.0, -1.0, 0.0;
  return T_body_camera;
}

}  // namespace geomap::drivers
