// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "geometry/depth_noise.hpp"
#include "geometry/polygon_clip.hpp"
#include "mapping/geometric_map.hpp"
#include "mapping/map_hash.hpp"
#include "support/axes.hpp"
#include "support/plane_renderer.hpp"

namespace geomap::testing {

/// @brief Of all that a map holds.
inline std::string hash_of(const mapping::GeometricMap& map) {
  return mapping::map_hash(map.features(), map.vetoes());
}

/// @brief Observes rectangles in closed form: what a perfect extraction would emit for a camera,
/// with Gaussian errors of the plane as a whole. Needs no depth image; only what the camera faces
/// is seen.
class Observer {
 public:
  explicit Observer(std::uint32_t seed = 1) : random_(seed) {}

  double angle_noise = 0.0;    // standard deviation of each normal's tilt [rad]
  double offset_noise = 0.0;   // of each plane's offset at its centre [m]
  double outline_noise = 0.0;  // of each corner along both sides [m]

  geometry::PlaneObservation see(const Rectangle& rectangle,
                                 const Eigen::Isometry3d& T_world_camera) {
    const Eigen::Vector3d eye = T_world_camera.translation();
    geometry::Plane plane = rectangle.plane_seen_from(eye);
    const Eigen::Vector3d tilt =
        gauss(angle_noise) * rectangle.u + gauss(angle_noise) * rectangle.v;
    const Eigen::Vector3d center = rectangle.center + gauss(offset_noise) * plane.normal;
    plane =
        geometry::Plane::through(center, (plane.normal + tilt.cross(plane.normal)).normalized());

    const Eigen::Isometry3d T_camera_world = T_world_camera.inverse();
    geometry::PlaneObservation seen;
    seen.surface.plane = plane.transformed(T_camera_world);
    seen.surface.frame =
        geometry::PlaneFrame::on(seen.surface.plane, T_camera_world * center,
                                 Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY());
    const Eigen::Isometry3d T_plane_world = seen.surface.frame.T_plane_parent() * T_camera_world;
    geometry::Ring ring;
    for (const auto& [su, sv] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
      const Eigen::Vector3d corner = center +
                                     (su * rectangle.half_u + gauss(outline_noise)) * rectangle.u +
                                     (sv * rectangle.half_v + gauss(outline_noise)) * rectangle.v;
      ring.push_back(geometry::to_grid((T_plane_world * corner).head<2>()));
    }
    const std::vector<geometry::Ring> rings = {ring};
    seen.surface.polygon = geometry::from_rings(rings, geometry::FillRule::kNonZero);
    add_points(rectangle, center, T_camera_world, seen);
    seen.rms = 0.002;
    seen.color = {static_cast<double>(rectangle.color[0]), static_cast<double>(rectangle.color[1]),
                  static_cast<double>(rectangle.color[2])};
    return seen;
  }

  std::shared_ptr<const mapping::Observation> observe(std::int64_t keyframe,
                                                      const std::vector<Rectangle>& scene,
                                                      const Eigen::Isometry3d& T_world_camera) {
    auto observation = std::make_shared<mapping::Observation>();
    observation->keyframe = keyframe;
    observation->T_world_camera = T_world_camera;
    for (const Rectangle& rectangle : scene) {
      observation->planes.push_back(see(rectangle, T_world_camera));
    }
    return observation;
  }

 private:
  double gauss(double sigma) { return sigma == 0.0 ? 0.0 : sigma * normal_(random_); }

  // Points on the observed plane: a grid over the rectangle.
  void add_points(const Rectangle& r, const Eigen::Vector3d& center,
                  const Eigen::Isometry3d& T_camera_world, geometry::PlaneObservation& seen) {
    constexpr int kSteps = 20;
    const geometry::DepthNoise noise;
    for (int i = -kSteps; i <= kSteps; ++i) {
      for (int j = -kSteps; j <= kSteps; ++j) {
        const Eigen::Vector3d p =
            T_camera_world * (center + r.half_u * i / kSteps * r.u + r.half_v * j / kSteps * r.v);
        const Eigen::Vector3d on_plane = seen.surface.plane.project(p);
        seen.moments.add(on_plane, noise.sigma(on_plane.z()));
        ++seen.inliers;
      }
    }
  }

  std::mt19937 random_;
  std::normal_distribution<double> normal_{0.0, 1.0};
};

}  // namespace geomap::testing
