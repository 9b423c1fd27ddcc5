// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "geometry/camera_model.hpp"
#include "geometry/plane.hpp"

namespace geomap::perception {

// Where image points lie on a plane of the camera frame whose normal is towards the camera (d > 0).

/// @brief False where the ray through an image point [pixel] misses the plane, or nearly so.
inline bool meets(const geometry::CameraModel& camera, const geometry::Plane& plane,
                  const Eigen::Vector2d& pixel) {
  constexpr double kLeastSlope = 0.02;
  return -plane.normal.dot(camera.ray(pixel.x(), pixel.y())) > kLeastSlope;
}

/// @brief Where the ray through an image point meets the plane, camera frame [m].
inline Eigen::Vector3d intersect(const geometry::CameraModel& camera, const geometry::Plane& plane,
                                 const Eigen::Vector2d& pixel) {
  const Eigen::Vector3d ray = camera.ray(pixel.x(), pixel.y());
  return -plane.d / plane.normal.dot(ray) * ray;
}

/// @brief Length on the plane [m] of one pixel at an image point, along the plane's slope.
inline double pixel_length(const geometry::CameraModel& camera, const geometry::Plane& plane,
                           const Eigen::Vector2d& pixel) {
  const Eigen::Vector3d ray = camera.ray(pixel.x(), pixel.y());
  const double slope = -plane.normal.dot(ray);
  return plane.d * ray.norm() / (slope * slope * std::min(camera.fx, camera.fy));
}

/// @brief Area on the plane [m²] that the pixel at an image point covers: z³/(fx fy d).
inline double pixel_area(const geometry::CameraModel& camera, const geometry::Plane& plane,
                         const Eigen::Vector2d& pixel) {
  const double z = intersect(camera, plane, pixel).z();
  return z * z * z / (camera.fx * camera.fy * plane.d);
}

}  // namespace geomap::perception
