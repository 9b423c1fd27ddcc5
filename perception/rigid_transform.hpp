// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

namespace geomap::perception {

/// @brief True when every number is finite and the linear part is a rotation (orthonormal within
/// 1e-6, determinant +1).
bool is_rigid(const Eigen::Isometry3d& T);

/// @brief The same pose with its rotation made orthonormal again, as products of many poses need.
Eigen::Isometry3d orthonormal(const Eigen::Isometry3d& T);

/// @brief Angle of the rotation that takes `a` to `b`, 0 to pi [rad].
double angle_between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b);

/// @brief Motion at constant velocity from `a` (fraction 0) to `b` (fraction 1): positions on a
/// straight line, rotations on the shortest arc. A fraction below 0 or above 1 continues the same
/// motion.
Eigen::Isometry3d interpolate(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b,
                              double fraction);

}  // namespace geomap::perception
