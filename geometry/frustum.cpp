// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/frustum.hpp"

#include <algorithm>
#include <stdexcept>

namespace geomap::geometry {

Frustum::Frustum(const CameraModel& camera, double near, double far,
                 const Eigen::Isometry3d& T_target_camera) {
  if (!camera.valid()) throw std::invalid_argument("frustum of an invalid camera");
  if (!(near > 0.0 && far > near)) throw std::invalid_argument("frustum needs 0 < near < far");

  const double left = -0.5, top = -0.5;
  const double right = camera.width - 0.5, bottom = camera.height - 0.5;
  const std::array<Eigen::Vector3d, 4> rays = {camera.ray(left, top), camera.ray(right, top),
                                               camera.ray(right, bottom), camera.ray(left, bottom)};
  for (std::size_t i = 0; i < 4; ++i) {
    corners_[i] = T_target_camera * (near * rays[i]);
    corners_[i + 4] = T_target_camera * (far * rays[i]);
    // Consecutive border rays span a side plane whose normal (this order) points inwards.
    const Eigen::Vector3d inwards = rays[i].cross(rays[(i + 1) % 4]).normalized();
    planes_[i] = Plane{inwards, 0.0}.transformed(T_target_camera);
  }
  planes_[4] = Plane{Eigen::Vector3d::UnitZ(), -near}.transformed(T_target_camera);
  planes_[5] = Plane{-Eigen::Vector3d::UnitZ(), far}.transformed(T_target_camera);
}

bool Frustum::contains(const Eigen::Vector3d& point) const {
  return std::all_of(planes_.begin(), planes_.end(),
                     [&](const Plane& plane) { return plane.signed_distance(point) >= 0.0; });
}

bool Frustum::may_intersect(const Eigen::AlignedBox3d& box) const {
  if (box.isEmpty()) return false;
  return std::all_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
    const Eigen::Vector3d farthest =
        (plane.normal.array() >= 0.0).select(box.max(), box.min());  // along the inward normal
    return plane.signed_distance(farthest) >= 0.0;
  });
}

}  // namespace geomap::geometry
