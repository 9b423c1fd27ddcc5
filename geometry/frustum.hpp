// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "geometry/camera_model.hpp"
#include "geometry/plane.hpp"

namespace geomap::geometry {

/// @brief What a camera can see: six planes, normals inwards (paper, section on frustum ICP).
class Frustum {
 public:
  /// @brief Frustum in the frame `target` of T_target_camera, between the depths `near` and `far`
  /// [m]. Image borders are the outer edges of the border pixels.
  /// @throws std::invalid_argument for an invalid camera or unless 0 < near < far.
  Frustum(const CameraModel& camera, double near, double far,
          const Eigen::Isometry3d& T_target_camera);

  bool contains(const Eigen::Vector3d& point) const;

  /// @brief False only when the box lies wholly outside one of the planes (conservative).
  bool may_intersect(const Eigen::AlignedBox3d& box) const;

  const std::array<Plane, 6>& planes() const { return planes_; }
  /// @brief Four near corners, then four far ones, in image order (top left, top right, bottom
  /// right, bottom left).
  const std::array<Eigen::Vector3d, 8>& corners() const { return corners_; }

 private:
  std::array<Plane, 6> planes_;
  std::array<Eigen::Vector3d, 8> corners_;
};

}  // namespace geomap::geometry
