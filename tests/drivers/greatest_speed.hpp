// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "drivers/camera_trajectory.hpp"
#include "geometry/angles.hpp"

namespace geomap::testing {

/// @brief Of a robot on its way.
struct Speed {
  double metres = 0.0;   // of the base [1/s]
  double degrees = 0.0;  // of the camera's direction [1/s]
};

/// @brief By differences over 10 ms.
inline Speed greatest_speed(const drivers::CameraTrajectory& trajectory) {
  constexpr double kStep = 0.01;  // [s]
  Speed greatest;
  for (double t = 0.0; t < trajectory.duration(); t += kStep) {
    const drivers::RobotPose before = trajectory.at(t);
    const drivers::RobotPose after = trajectory.at(t + kStep);
    const Eigen::Isometry3d moved = before.T_world_body.inverse() * after.T_world_body;
    const Eigen::Isometry3d turned = (before.T_world_body * before.T_body_camera).inverse() *
                                     (after.T_world_body * after.T_body_camera);
    const double angle = Eigen::AngleAxisd(turned.linear()).angle();
    greatest.metres = std::max(greatest.metres, moved.translation().norm() / kStep);
    greatest.degrees = std::max(greatest.degrees, geometry::degrees(angle) / kStep);
  }
  return greatest;
}

}  // namespace geomap::testing
