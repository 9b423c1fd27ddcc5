// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane_frame.hpp"

#include <cmath>

namespace geomap::geometry {
namespace {

constexpr double kSinOf15Degrees = 0.25881904510252074;

Eigen::Vector3d in_plane(const Eigen::Vector3d& v, const Eigen::Vector3d& normal) {
  return v - v.dot(normal) * normal;
}

}  // namespace

PlaneFrame PlaneFrame::on(const Plane& plane, const Eigen::Vector3d& near,
                          const Eigen::Vector3d& x_hint, const Eigen::Vector3d& y_hint) {
  Eigen::Vector3d x = in_plane(x_hint.normalized(), plane.normal);
  if (x.norm() < kSinOf15Degrees) {
    x = in_plane(y_hint.normalized(), plane.normal).cross(plane.normal);
  }
  return {plane.project(near), x.normalized(), plane.normal};
}

Eigen::Isometry3d PlaneFrame::T_parent_plane() const {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() << x_axis, y_axis(), normal;
  T.translation() = origin;
  return T;
}

PlaneFrame PlaneFrame::transformed(const Eigen::Isometry3d& T_target_parent) const {
  PlaneFrame result;
  result.origin = T_target_parent * origin;
  result.normal = (T_target_parent.linear() * normal).normalized();
  result.x_axis = in_plane(T_target_parent.linear() * x_axis, result.normal).normalized();
  return result;
}

}  // namespace geomap::geometry
