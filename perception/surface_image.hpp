// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "geometry/camera_model.hpp"
#include "geometry/depth_noise.hpp"
#include "geometry/rgbd_frame.hpp"

namespace geomap::perception {

/// @brief The surface around one pixel: a plane, as inverse depth over the viewing ray (x, y, 1):
/// 1/z = a x + b y + c [1/m].
struct SurfacePixel {
  Eigen::Vector3d inverse_depth = Eigen::Vector3d::Zero();  // (a, b, c)
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();         // unit, towards the camera; 0: none
  Eigen::Vector3d point = Eigen::Vector3d::Zero();          // on the plane, on the pixel's ray [m]

  bool valid() const { return normal.z() != 0.0; }

  /// @brief Where the viewing ray of a point of the camera frame (z > 0) meets the plane [m];
  /// nothing when it does not meet it before the camera.
  std::optional<Eigen::Vector3d> on_ray_of(const Eigen::Vector3d& p) const {
    const double q = inverse_depth.dot(p);  // of the plane at p's ray, times p.z
    if (!(q > 0.0)) return std::nullopt;
    return p / q;
  }
};

/// @brief A (thin) depth image as surfaces: to each pixel the plane through the readings around it
/// that lie on its surface. Camera frame, metres.
///
/// Inverse depth is linear over a plane's image and its noise lies along the ray, so the fit is not
/// tilted by noise. Windows of 5 x 5 pixels, where those are not flat of 3 x 3; pixels beside depth
/// edges use their own side alone. A pixel has no surface where too little around it was read,
/// where nothing flat fits, or where the surface is seen at more than about 81 degrees.
class SurfaceImage {
 public:
  static constexpr double kNearest = 0.1;  // no camera of this kind sees nearer [m]

  /// @param noise of a reading; a plane must fit within 1.5 sigma rms.
  /// @throws std::invalid_argument when depth image and camera disagree in size.
  SurfaceImage(const geometry::RgbdFrame& frame, double min_depth, double max_depth,
               const geometry::DepthNoise& noise = {});

  int width() const { return camera_.width; }
  int height() const { return camera_.height; }
  const geometry::CameraModel& camera() const { return camera_; }
  const SurfacePixel& at(int u, int v) const {
    return pixels_[static_cast<std::size_t>(v * camera_.width + u)];
  }
  /// @brief The surface at the pixel onto which a point of the camera frame falls; nullptr when it
  /// falls outside the image, lies behind the camera, or there is no surface.
  const SurfacePixel* seen_at(const Eigen::Vector3d& p) const {
    if (!(p.z() > kNearest)) return nullptr;
    const double u = camera_.fx * p.x() / p.z() + camera_.cx + 0.5;
    const double v = camera_.fy * p.y() / p.z() + camera_.cy + 0.5;
    if (!(u >= 0.0 && v >= 0.0 && u < camera_.width && v < camera_.height)) return nullptr;
    const SurfacePixel& pixel = at(static_cast<int>(u), static_cast<int>(v));
    return pixel.valid() ? &pixel : nullptr;
  }
  /// @brief All of them, row by row, and one more without a surface.
  const SurfacePixel* pixels() const { return pixels_.data(); }
  int size() const { return valid_; }            // pixels with a surface
  double farthest() const { return farthest_; }  // largest depth with a surface [m]

 private:
  geometry::CameraModel camera_;
  std::vector<SurfacePixel> pixels_;  // row by row, and an empty one
  int valid_ = 0;
  double farthest_ = 0.0;
};

}  // namespace geomap::perception
