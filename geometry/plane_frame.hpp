// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "geometry/plane.hpp"

namespace geomap::geometry {

/// @brief Coordinate frame of a polygon: origin near the polygon, z along the plane's normal, x
/// along a hint of the caller's (the first observing camera's x), so that nothing depends on the
/// world's axes.
///
/// Replaces equations 8-10 of the paper, which divide by n_x + n_y + n_z and print t with a wrong
/// sign. Holds nine numbers: the y axis is always normal × x, so a frame is the same after any
/// round trip.
struct PlaneFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();   // in the parent frame [m]
  Eigen::Vector3d x_axis = Eigen::Vector3d::UnitX();  // unit, in the parent frame
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // unit, in the parent frame

  /// @brief Frame on `plane` at the projection of `near`, x axis along the projection of `x_hint`,
  /// or of `y_hint` turned by -90° when the first is within 15° of the normal.
  static PlaneFrame on(const Plane& plane, const Eigen::Vector3d& near,
                       const Eigen::Vector3d& x_hint, const Eigen::Vector3d& y_hint);

  Eigen::Vector3d y_axis() const { return normal.cross(x_axis); }

  /// @brief T_parent_plane.
  Eigen::Isometry3d T_parent_plane() const;
  /// @brief T_plane_parent.
  Eigen::Isometry3d T_plane_parent() const { return T_parent_plane().inverse(); }

  /// @brief The plane z = 0 of this frame, in the parent frame.
  Plane plane() const { return Plane::through(origin, normal); }

  /// @brief The same frame in the parent `target`, axes re-normalised.
  PlaneFrame transformed(const Eigen::Isometry3d& T_target_parent) const;
};

}  // namespace geomap::geometry
