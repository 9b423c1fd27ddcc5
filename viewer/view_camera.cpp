// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/view_camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace geomap::viewer {
namespace {

constexpr double kNearest = 0.05, kFarthest = 5'000.0;  // of the eye from the target [m]
constexpr double kRadiansPerPixel = 0.008;
constexpr double kNear = 0.02, kReach = 20'000.0;  // of the clip planes [m]
constexpr double kMargin = 1.08;                   // around what is to be in view
constexpr double kLeastExtent = 0.25;              // of it, half of its width or height [m]

double wrapped(double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); }

}  // namespace

void ViewCamera::resize(int width, int height) {
  width_ = std::max(1, width);
  height_ = std::max(1, height);
}

void ViewCamera::set(const Viewpoint& viewpoint) {
  viewpoint_ = viewpoint;
  viewpoint_.distance = std::clamp(viewpoint.distance, kNearest, kFarthest);
  viewpoint_.pitch = std::clamp(viewpoint.pitch, -std::numbers::pi / 2.0, std::numbers::pi / 2.0);
  viewpoint_.yaw = wrapped(viewpoint.yaw);
}

void ViewCamera::look_from(const std::optional<Eigen::Isometry3d>& T_world_camera, double fov_y) {
  first_person_ = T_world_camera;
  fov_y_ = T_world_camera ? fov_y : viewpoint_fov_y_;
}

void ViewCamera::orbit(double dx, double dy) {
  Viewpoint turned = viewpoint_;
  turned.yaw -= kRadiansPerPixel * dx;
  turned.pitch += kRadiansPerPixel * dy;
  set(turned);
}

void ViewCamera::pan(double dx, double dy) {
  const double step = metres_per_pixel(viewpoint_.target);
  viewpoint_.target += axes().leftCols<2>() * Eigen::Vector2d(-dx * step, dy * step);
}

void ViewCamera::zoom(double factor, const Eigen::Vector2d& pixel) {
  const double distance = std::clamp(viewpoint_.distance * factor, kNearest, kFarthest);
  const double share = distance / viewpoint_.distance;
  const double step = metres_per_pixel(viewpoint_.target);
  const Eigen::Vector2d offset(pixel.x() - 0.5 * width_, 0.5 * height_ - pixel.y());
  viewpoint_.target += axes().leftCols<2>() * (offset * step * (1.0 - share));
  viewpoint_.distance = distance;
}

Viewpoint ViewCamera::fitting(const Eigen::AlignedBox3d& box) const {
  Viewpoint fitted = viewpoint_;
  if (box.isEmpty()) return fitted;
  fitted.target = box.center();
  const Eigen::Matrix3d turn = axes();
  const double slope = std::tan(0.5 * viewpoint_fov_y_);
  const double aspect = static_cast<double>(width_) / height_;
  const bool is_deep = fitted.projection == Projection::kPerspective;
  double distance = 0.0;
  for (int i = 0; i < 8; ++i) {
    const auto corner = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
    // Right, up, and towards the eye.
    const Eigen::Vector3d offset = turn.transpose() * (corner - fitted.target);
    const double extent =
        std::max({std::abs(offset.y()), std::abs(offset.x()) / aspect, kLeastExtent});
    distance = std::max(distance, kMargin * extent / slope + (is_deep ? offset.z() : 0.0));
  }
  fitted.distance = std::clamp(distance, kNearest, kFarthest);
  return fitted;
}

bool ViewCamera::is_orthographic() const {
  return viewpoint_.projection == Projection::kOrthographic && !first_person_;
}

Eigen::Matrix3d ViewCamera::axes() const {
  if (first_person_) {
    Eigen::Matrix3d flipped = first_person_->linear();
    flipped.rightCols<2>() *= -1.0;  // optical: y down, z forward
    return flipped;
  }
  const auto [yaw, pitch] = std::pair(viewpoint_.yaw, viewpoint_.pitch);
  Eigen::Matrix3d axes;
  axes.col(0) << -std::sin(yaw), std::cos(yaw), 0.0;
  axes.col(2) << std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), std::sin(pitch);
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

Eigen::Vector3d ViewCamera::eye() const {
  if (first_person_) return first_person_->translation();
  return viewpoint_.target + viewpoint_.distance * axes().col(2);
}

Eigen::Vector3d ViewCamera::forward() const { return -axes().col(2); }

Eigen::Matrix4d ViewCamera::view() const {
  Eigen::Isometry3d T_world_view = Eigen::Isometry3d::Identity();
  T_world_view.linear() = axes();
  T_world_view.translation() = eye();
  return T_world_view.inverse().matrix();
}

Eigen::Matrix4d ViewCamera::projection() const {
  const double aspect = static_cast<double>(width_) / height_;
  Eigen::Matrix4d projection = Eigen::Matrix4d::Zero();
  if (is_orthographic()) {
    const double half = viewpoint_.distance * std::tan(0.5 * fov_y_);
    // Things behind the eye's plane are drawn too: seen from above nothing is above the eye.
    const double reach = viewpoint_.distance + kFarthest;
    projection(0, 0) = 1.0 / (half * aspect);
    projection(1, 1) = 1.0 / half;
    projection(2, 2) = -1.0 / reach;
    projection(3, 3) = 1.0;
    return projection;
  }
  const double near = first_person_ ? kNear : std::max(kNear, 0.01 * viewpoint_.distance);
  const double far = std::min(kReach, 20'000.0 * near);
  const double focal = 1.0 / std::tan(0.5 * fov_y_);
  projection(0, 0) = focal / aspect;
  projection(1, 1) = focal;
  projection(2, 2) = (far + near) / (near - far);
  projection(2, 3) = 2.0 * far * near / (near - far);
  projection(3, 2) = -1.0;
  return projection;
}

Ray ViewCamera::ray(const Eigen::Vector2d& pixel) const {
  const double slope = std::tan(0.5 * fov_y_);
  const Eigen::Vector2d offset =
      Eigen::Vector2d(pixel.x() - 0.5 * width_, 0.5 * height_ - pixel.y()) / (0.5 * height_);
  const Eigen::Matrix3d turn = axes();
  if (is_orthographic()) {
    const Eigen::Vector2d shift = offset * viewpoint_.distance * slope;
    // From far enough that everything that is drawn lies ahead.
    const Eigen::Vector3d start = eye() + turn.leftCols<2>() * shift + kFarthest * turn.col(2);
    return {start, -turn.col(2)};
  }
  const Eigen::Vector3d direction =
      turn * Eigen::Vector3d(offset.x() * slope, offset.y() * slope, -1.0);
  return {eye(), direction.normalized()};
}

std::optional<Eigen::Vector2d> ViewCamera::project(const Eigen::Vector3d& point) const {
  const Eigen::Vector4d clip = view_projection() * point.homogeneous();
  if (!(clip.w() > 1e-9)) return std::nullopt;
  return Eigen::Vector2d(0.5 * width_ * (1.0 + clip.x() / clip.w()),
                         0.5 * height_ * (1.0 - clip.y() / clip.w()));
}

double ViewCamera::metres_per_pixel(const Eigen::Vector3d& point) const {
  const double depth =
      is_orthographic() ? viewpoint_.distance : std::max(kNear, (point - eye()).dot(forward()));
  return 2.0 * depth * std::tan(0.5 * fov_y_) / height_;
}

Viewpoint between(const Viewpoint& from, const Viewpoint& to, double share) {
  if (share >= 1.0) return to;
  Viewpoint viewpoint = to;
  viewpoint.target = from.target + share * (to.target - from.target);
  viewpoint.distance = from.distance * std::pow(to.distance / from.distance, share);
  viewpoint.yaw = wrapped(from.yaw + share * wrapped(to.yaw - from.yaw));
  viewpoint.pitch = from.pitch + share * (to.pitch - from.pitch);
  return viewpoint;
}

}  // namespace geomap::viewer
