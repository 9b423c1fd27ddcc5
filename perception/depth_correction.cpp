// SPDX-License-Identifier: BSD-3-Clause
#include "perception/depth_correction.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace geomap::perception {
namespace {

// Viewing rays at the border of a Kinect's image. They only set the unit of the coefficients.
constexpr double kBorderX = 0.55;
constexpr double kBorderY = 0.41;
constexpr int kSamples = 9;  // along each axis, where corrections are compared

}  // namespace

DepthCorrection::Terms DepthCorrection::terms(double ray_x, double ray_y) {
  const double x = ray_x / kBorderX, y = ray_y / kBorderY;
  const double xx = x * x, xy = x * y, yy = y * y;
  Terms t;
  t << x, y, xx, xy, yy, xx * x, xx * y, x * yy, yy * y, xx * xx, xx * xy, xx * yy, xy * yy,
      yy * yy;
  return t;
}

double DepthCorrection::largest_difference(const DepthCorrection& a, const DepthCorrection& b,
                                           const geometry::CameraModel& camera) {
  const DepthCorrection difference(a.coefficients_ - b.coefficients_);
  double largest = 0.0;
  for (int row = 0; row < kSamples; ++row) {
    for (int column = 0; column < kSamples; ++column) {
      const Eigen::Vector3d ray = camera.ray(column * (camera.width - 1.0) / (kSamples - 1),
                                             row * (camera.height - 1.0) / (kSamples - 1));
      largest = std::max(largest, std::abs(difference.share(ray.x(), ray.y())));
    }
  }
  return largest;
}

geometry::RgbdFrame corrected(const geometry::RgbdFrame& frame, const DepthCorrection& correction) {
  const geometry::CameraModel& camera = frame.depth_camera;
  if (!camera.valid() || frame.depth.width != camera.width || frame.depth.height != camera.height ||
      frame.depth.millimetres.size() !=
          static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height)) {
    throw std::invalid_argument("depth correction: depth image and camera disagree");
  }
  geometry::RgbdFrame result = frame;
  if (correction.is_none()) return result;
  auto pixel = result.depth.millimetres.begin();
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u, ++pixel) {
      if (!geometry::DepthImage::is_reading(*pixel)) continue;
      const Eigen::Vector3d ray = camera.ray(u, v);
      const double depth = std::round(*pixel * (1.0 + correction.share(ray.x(), ray.y())));
      if (depth > 0.5 && depth < 65534.5) *pixel = static_cast<std::uint16_t>(depth);
    }
  }
  return result;
}

}  // namespace geomap::perception
