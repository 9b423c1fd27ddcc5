// SPDX-License-Identifier: BSD-3-Clause
#include "registration_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "geometry/angles.hpp"
#include "geometry/depth_noise.hpp"

namespace geomap::perception {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using testing::Rectangle;

constexpr double kSpacing = 0.04;  // of surfels [m]
constexpr double kReach = 6.0;     // of surfels from the camera [m]

Rectangle plane(const std::string& name, const Vector3d& center, const Vector3d& u,
                const Vector3d& v, double half_v = 8.0) {
  return {name, center, u, v, 8.0, half_v, {200, 200, 200}, {}};
}

Vector3d any_direction(std::mt19937& generator) {
  std::normal_distribution<double> normal(0.0, 1.0);
  const double x = normal(generator), y = normal(generator), z = normal(generator);
  return Vector3d(x, y, z).normalized();
}

Vector3d without(Vector3d value, const std::vector<Vector3d>& directions) {
  for (const Vector3d& d : directions) value -= d * d.dot(value);
  return value;
}

double largest_along(const Vector3d& value, const std::vector<Vector3d>& directions) {
  double largest = 0.0;
  for (const Vector3d& d : directions) largest = std::max(largest, std::abs(d.dot(value)));
  return largest;
}

}  // namespace

RegistrationScene room_scene() {
  return {
      "room", testing::small_room(), testing::look_at({0.9, -1.1, 1.4}, {-0.5, 1.2, 0.6}), {}, {}};
}

std::vector<RegistrationScene> degenerate_scenes() {
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  const Rectangle floor = plane("floor", Vector3d::Zero(), x, y);
  const Rectangle wall = plane("wall", {0.0, 2.0, 0.0}, x, z);
  const Rectangle left = plane("left", {-0.9, 0.0, 1.3}, y, z, 1.3);
  const Rectangle right = plane("right", {0.8, 0.0, 1.3}, y, z, 1.3);
  return {
      {"wall", {wall}, testing::look_at({0.3, 0.1, 1.2}, {0.7, 2.0, 1.0}), {x, z}, {y}},
      {"floor", {floor}, testing::look_at({0.2, 0.1, 1.3}, {0.6, 1.4, 0.0}), {x, y}, {z}},
      {"parallel walls",
       {left, right},
       testing::look_at({0.1, 0.0, 1.3}, {0.0, 3.0, 1.2}),
       {y, z},
       {x}},
      {"corridor",
       {floor, left, right},
       testing::look_at({0.1, 0.0, 1.3}, {0.0, 3.0, 0.5}),
       {y},
       {}},
  };
}

RegistrationScene moved(const RegistrationScene& scene, const Isometry3d& T) {
  RegistrationScene result = scene;
  for (Rectangle& rectangle : result.rectangles) {
    rectangle.center = T * rectangle.center;
    rectangle.u = T.linear() * rectangle.u;
    rectangle.v = T.linear() * rectangle.v;
  }
  result.T_world_camera = T * scene.T_world_camera;
  for (Vector3d& d : result.open_translations) d = T.linear() * d;
  for (Vector3d& d : result.open_rotations) d = T.linear() * d;
  return result;
}

Isometry3d far_away() {
  Isometry3d T = Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(1.1, Vector3d(0.36, -0.48, 0.8).normalized()).toRotationMatrix();
  T.translation() = Vector3d(700.0, -640.0, 310.0);
  return T;
}

std::vector<RegistrationScene> near_and_far(const std::vector<RegistrationScene>& scenes) {
  std::vector<RegistrationScene> all = scenes;
  for (const RegistrationScene& scene : scenes) {
    all.push_back(moved(scene, far_away()));
    all.back().name += ", far away and turned";
  }
  return all;
}

std::vector<Surfel> exact_surfels(const RegistrationScene& scene) {
  const Vector3d eye = scene.T_world_camera.translation();
  std::vector<Surfel> surfels;
  for (const Rectangle& r : scene.rectangles) {
    const Vector3d normal = r.plane_seen_from(eye).normal;
    for (double u = -r.half_u + 0.5 * kSpacing; u < r.half_u; u += kSpacing) {
      for (double v = -r.half_v + 0.5 * kSpacing; v < r.half_v; v += kSpacing) {
        const Vector3d p = r.center + u * r.u + v * r.v;
        if ((p - eye).norm() < kReach) surfels.push_back({p, normal});
      }
    }
  }
  return surfels;
}

SurfaceImage exact_view(const RegistrationScene& scene, const Isometry3d& T_world_camera) {
  const auto rendering =
      testing::render(scene.rectangles, testing::kinect_camera(7), T_world_camera);
  return {rendering.frame, 0.4, 5.0};
}

geometry::RgbdFrame noisy_frame(const RegistrationScene& scene, const Isometry3d& T_world_camera,
                                std::uint32_t seed) {
  auto rendering = testing::render(scene.rectangles, testing::kinect_camera(), T_world_camera);
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  const geometry::DepthNoise noise;
  for (std::size_t i = 0; i < rendering.depth.size(); ++i) {
    const double z = rendering.depth[i];
    if (z == 0.0) continue;
    const double reading = z + noise.sigma(z) * normal(generator);
    rendering.frame.depth.millimetres[i] =
        static_cast<std::uint16_t>(std::clamp(std::lround(1e3 * reading), 1L, 65534L));
  }
  return rendering.frame;
}

Isometry3d disturbed(const Isometry3d& T_world_camera, double metres, double degrees,
                     unsigned seed) {
  std::mt19937 generator(seed);
  const Vector3d direction = any_direction(generator), axis = any_direction(generator);
  Isometry3d T = T_world_camera;
  T.linear() = Eigen::AngleAxisd(geometry::radians(degrees), axis) * T_world_camera.linear();
  T.translation() += metres * direction;
  return T;
}

Motion motion(const Isometry3d& from, const Isometry3d& to) {
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond(to.linear() * from.linear().transpose()).normalized();
  const Vector3d half = turn.w() < 0.0 ? Vector3d(-turn.vec()) : Vector3d(turn.vec());
  const double sine = half.norm();
  const double angle = 2.0 * std::asin(std::min(1.0, sine));
  return {to.translation() - from.translation(),
          sine > 0.0 ? Vector3d(angle / sine * half) : Vector3d::Zero()};
}

MotionSize open_part(const RegistrationScene& scene, const Motion& motion) {
  return {largest_along(motion.translation, scene.open_translations),
          largest_along(motion.rotation, scene.open_rotations)};
}

MotionSize observed_part(const RegistrationScene& scene, const Motion& motion) {
  return {without(motion.translation, scene.open_translations).norm(),
          without(motion.rotation, scene.open_rotations).norm()};
}

void Worst::add(const MotionSize& size) {
  metres = std::max(metres, size.metres);
  degrees = std::max(degrees, geometry::degrees(size.radians));
}

void Worst::record(const std::string& what) const {
  ::testing::Test::RecordProperty(what + " [m]", std::to_string(metres));
  ::testing::Test::RecordProperty(what + " [deg]", std::to_string(degrees));
}

}  // namespace geomap::perception
