// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "perception/frustum_icp.hpp"
#include "perception/surface_image.hpp"
#include "support/plane_renderer.hpp"

namespace geomap::perception {

/// @brief Rectangles, where a camera stands before them, and what its view cannot tell.
struct RegistrationScene {
  std::string name;
  std::vector<testing::Rectangle> rectangles;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  // Unit directions of the world along which, and about which through the camera's centre, the
  // camera can move without any residual changing.
  std::vector<Eigen::Vector3d> open_translations;
  std::vector<Eigen::Vector3d> open_rotations;

  int observed_directions() const {
    return 6 - static_cast<int>(open_translations.size() + open_rotations.size());
  }
};

/// @brief The small room, which fixes all six directions.
RegistrationScene room_scene();

/// @brief One wall, a floor, two walls that face each other, and a corridor of floor and two walls.
std::vector<RegistrationScene> degenerate_scenes();

/// @brief The scene as a whole moved by T.
RegistrationScene moved(const RegistrationScene& scene, const Eigen::Isometry3d& T);

/// @brief A turn about an axis that no scene is aligned with, and a kilometre away.
Eigen::Isometry3d far_away();

/// @brief Exact points of the rectangles on a 4 cm grid, up to 6 m from the camera, with their
/// exact normals.
std::vector<Surfel> exact_surfels(const RegistrationScene& scene);

/// @brief The scenes where they are, and each turned and a kilometre from the origin.
std::vector<RegistrationScene> near_and_far(const std::vector<RegistrationScene>& scenes);

/// @brief What a thinned Kinect sees without noise, rounded to the millimetre.
SurfaceImage exact_view(const RegistrationScene& scene, const Eigen::Isometry3d& T_world_camera);

/// @brief A full image with the noise of a Kinect: DepthNoise::sigma() of each pixel's depth.
geometry::RgbdFrame noisy_frame(const RegistrationScene& scene,
                                const Eigen::Isometry3d& T_world_camera, std::uint32_t seed);

/// @brief The pose moved by `metres` and turned about its centre by `degrees`, each in a direction
/// that the seed chooses.
Eigen::Isometry3d disturbed(const Eigen::Isometry3d& T_world_camera, double metres, double degrees,
                            unsigned seed);

/// @brief What takes `from` to `to`, in the world's axes, about the camera's centre.
struct Motion {
  Eigen::Vector3d translation;  // [m]
  Eigen::Vector3d rotation;     // axis times angle [rad]
};
Motion motion(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to);

/// @brief Largest parts of a motion along and about the scene's open directions.
struct MotionSize {
  double metres = 0.0;
  double radians = 0.0;
};
MotionSize open_part(const RegistrationScene& scene, const Motion& motion);

/// @brief Length and angle of what is left of a motion without the open directions.
MotionSize observed_part(const RegistrationScene& scene, const Motion& motion);

/// @brief Largest errors of many alignments; record() writes them into the report of the test.
struct Worst {
  double metres = 0.0;
  double degrees = 0.0;
  void add(const MotionSize& size);
  void record(const std::string& what) const;
};

}  // namespace geomap::perception
