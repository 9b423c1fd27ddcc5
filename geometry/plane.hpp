// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

namespace geomap::geometry {

/// @brief Oriented plane n·x + d = 0 with |n| = 1; n points to the side the plane was seen from.
/// The frame is that of the owner's documentation (camera, plane or world); metres.
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double d = 0.0;  // [m]

  /// @brief Signed distance [m] of a point, positive on the side the normal points to.
  double signed_distance(const Eigen::Vector3d& point) const { return normal.dot(point) + d; }

  /// @brief Nearest point of the plane to `point`.
  Eigen::Vector3d project(const Eigen::Vector3d& point) const {
    return point - signed_distance(point) * normal;
  }

  /// @brief The same surface seen from the other side. The only place where a sign is turned.
  Plane flipped() const { return {-normal, -d}; }

  /// @brief The plane through `point` with unit `normal`.
  static Plane through(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
    return {normal, -normal.dot(point)};
  }

  /// @brief The plane in the frame `target`, given in the frame `source`.
  Plane transformed(const Eigen::Isometry3d& T_target_source) const {
    const Eigen::Vector3d turned = T_target_source.linear() * normal;
    return {turned, d - turned.dot(T_target_source.translation())};
  }
};

/// @brief Angle between the normals [rad], 0 to pi; exact near 0 and pi (atan2, not acos).
double angle_between(const Plane& a, const Plane& b);

}  // namespace geomap::geometry
