// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "geometry/camera_model.hpp"
#include "geometry/depth_noise.hpp"
#include "geometry/plane.hpp"
#include "geometry/rgbd_frame.hpp"

namespace geomap::testing {

/// @brief A rectangle in the world: centre, two unit directions at right angles and half sizes; its
/// normal is u × v. Points of the openings (rectangles in (u, v) about the centre) are air.
struct Rectangle {
  std::string name;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d u = Eigen::Vector3d::UnitX();
  Eigen::Vector3d v = Eigen::Vector3d::UnitY();
  double half_u = 1.0;  // [m]
  double half_v = 1.0;  // [m]
  std::array<std::uint8_t, 3> color = {200, 200, 200};
  std::vector<Eigen::AlignedBox2d> openings;

  /// The plane, its normal on the side of `viewpoint`.
  geometry::Plane plane_seen_from(const Eigen::Vector3d& viewpoint) const;
};

/// @brief What a noise-free camera sees: depth and, per pixel, which rectangle (-1: none).
struct Rendering {
  geometry::RgbdFrame frame;
  std::vector<int> label;
  std::vector<double> depth;  // exact, before rounding and noise [m]; 0 where nothing is hit
};

/// @brief Kinect-like camera: 640x480, fx = fy = 585, scaled down by `divisor`.
geometry::CameraModel kinect_camera(int divisor = 1);

/// @brief Camera at `eye` looking at `target`; `up` is the world's up direction. T_world_camera.
Eigen::Isometry3d look_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target,
                          const Eigen::Vector3d& up = Eigen::Vector3d::UnitZ());

/// @brief Closed-form rendering of rectangles: the nearest hit of each pixel's ray, in 0.3 m to 10
/// m.
/// @param sigma white noise on depth [m], seeded; 0 for exact readings rounded to 1 mm.
Rendering render(const std::vector<Rectangle>& scene, const geometry::CameraModel& camera,
                 const Eigen::Isometry3d& T_world_camera, double sigma = 0.0,
                 std::uint32_t seed = 1);

/// @brief A small room around the origin (z up): floor, back and left wall, and a table with a top.
std::vector<Rectangle> small_room();

}  // namespace geomap::testing
