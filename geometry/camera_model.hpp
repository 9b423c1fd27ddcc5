// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace geomap::geometry {

/// @brief Pinhole camera without distortion. Pixel (u, v) means the centre of column u, row v,
/// counted from 0 at the top left; the camera frame is optical (x right, y down, z forward).
struct CameraModel {
  int width = 0;    // [pixel]
  int height = 0;   // [pixel]
  double fx = 0.0;  // [pixel]
  double fy = 0.0;  // [pixel]
  double cx = 0.0;  // [pixel]
  double cy = 0.0;  // [pixel]

  /// @brief Viewing ray p / z through a pixel: a point at depth z is z * ray.
  Eigen::Vector3d ray(double u, double v) const { return {(u - cx) / fx, (v - cy) / fy, 1.0}; }

  /// @brief Point in the camera frame [m] at depth `z` [m] along the optical axis.
  Eigen::Vector3d point(double u, double v, double z) const { return z * ray(u, v); }

  /// @brief Pixel coordinates of a point of the camera frame with z > 0.
  Eigen::Vector2d project(const Eigen::Vector3d& p) const {
    return {fx * p.x() / p.z() + cx, fy * p.y() / p.z() + cy};
  }

  /// @brief True when size and focal lengths are positive, and everything is finite.
  bool valid() const;

  bool operator==(const CameraModel&) const = default;
};

}  // namespace geomap::geometry
