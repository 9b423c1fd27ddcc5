// SPDX-License-Identifier: BSD-3-Clause
#include "support/plane_renderer.hpp"

#include <algorithm>
#include <cmath>

namespace geomap::testing {
namespace {

using Eigen::Vector3d;

constexpr double kNear = 0.3;  // [m]
constexpr double kFar = 10.0;  // [m]

// Depth along the optical axis at which the ray meets the rectangle, or 0.
double hit(const Rectangle& r, const Vector3d& eye, const Vector3d& direction) {
  const Vector3d normal = r.u.cross(r.v);
  const double slope = normal.dot(direction);
  if (std::abs(slope) < 1e-12) return 0.0;
  const double t = normal.dot(r.center - eye) / slope;
  if (t < kNear || t > kFar) return 0.0;
  const Vector3d from_center = eye + t * direction - r.center;
  const Eigen::Vector2d at(from_center.dot(r.u), from_center.dot(r.v));
  if (std::abs(at.x()) > r.half_u || std::abs(at.y()) > r.half_v) return 0.0;
  const bool open = std::any_of(r.openings.begin(), r.openings.end(),
                                [&](const Eigen::AlignedBox2d& box) { return box.contains(at); });
  return open ? 0.0 : t;
}

}  // namespace

geometry::Plane Rectangle::plane_seen_from(const Vector3d& viewpoint) const {
  const geometry::Plane plane = geometry::Plane::through(center, u.cross(v).normalized());
  return plane.signed_distance(viewpoint) < 0.0 ? plane.flipped() : plane;
}

geometry::CameraModel kinect_camera(int divisor) {
  const double s = 1.0 / divisor;
  return {640 / divisor, 480 / divisor, 585.0 * s, 585.0 * s, 320.0 * s, 240.0 * s};
}

Eigen::Isometry3d look_at(const Vector3d& eye, const Vector3d& target, const Vector3d& up) {
  const Vector3d z = (target - eye).normalized();
  const Vector3d x = z.cross(up).normalized();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() << x, z.cross(x), z;
  T.translation() = eye;
  return T;
}

Rendering render(const std::vector<Rectangle>& scene, const geometry::CameraModel& camera,
                 const Eigen::Isometry3d& T_world_camera, double sigma, std::uint32_t seed) {
  Rendering result;
  const auto pixels = static_cast<std::size_t>(camera.width * camera.height);
  result.label.assign(pixels, -1);
  result.depth.assign(pixels, 0.0);
  geometry::RgbdFrame& frame = result.frame;
  frame.sensor = "plane_renderer";
  frame.depth_camera = frame.color_camera = camera;
  frame.depth = {camera.width, camera.height, std::vector<std::uint16_t>(pixels, 0)};
  frame.color = {camera.width, camera.height, std::vector<std::uint8_t>(3 * pixels, 0)};

  std::mt19937 generator(seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  std::size_t i = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u, ++i) {
      const Vector3d direction = T_world_camera.linear() * camera.ray(u, v);
      double nearest = kFar;
      for (std::size_t k = 0; k < scene.size(); ++k) {
        const double t = hit(scene[k], T_world_camera.translation(), direction);
        if (t > 0.0 && t < nearest) {
          nearest = t;
          result.label[i] = static_cast<int>(k);
        }
      }
      if (result.label[i] < 0) continue;
      result.depth[i] = nearest;
      const double reading = nearest + (sigma > 0.0 ? sigma * noise(generator) : 0.0);
      frame.depth.millimetres[i] =
          static_cast<std::uint16_t>(std::clamp(std::lround(reading * 1000.0), 1L, 65534L));
      const auto& color = scene[static_cast<std::size_t>(result.label[i])].color;
      std::copy(color.begin(), color.end(), frame.color.rgb.begin() + static_cast<long>(3 * i));
    }
  }
  return result;
}

std::vector<Rectangle> small_room() {
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  return {
      {"floor", {0.0, 0.0, 0.0}, x, y, 2.0, 2.0, {120, 90, 60}, {}},
      {"back wall", {0.0, 2.0, 1.25}, x, z, 2.0, 1.25, {210, 210, 200}, {}},
      {"left wall", {-2.0, 0.0, 1.25}, y, z, 2.0, 1.25, {180, 200, 220}, {}},
      {"table top", {0.3, 1.0, 0.75}, x, y, 0.6, 0.4, {160, 60, 40}, {}},
  };
}

}  // namespace geomap::testing
