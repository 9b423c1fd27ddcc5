// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/depth_correction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "geometry/multiversion.hpp"

namespace geomap::geometry {
namespace {

// Viewing rays at the border of a Kinect's image. They only set the unit of the coefficients.
constexpr double kBorderX = 0.55;
constexpr double kBorderY = 0.41;
constexpr int kSamples = 9;  // along each axis, where corrections are compared
constexpr int kDegree = 4;

// The polynomial along a row of the image: coefficients of the powers of x.
std::array<double, kDegree + 1> along_row(const DepthCorrection::Terms& c, double ray_y) {
  const double y = ray_y / kBorderY;
  return {y * (c(1) + y * (c(4) + y * (c(8) + y * c(13)))),
          c(0) + y * (c(3) + y * (c(7) + y * c(12))), c(2) + y * (c(6) + y * c(11)),
          c(5) + y * c(10), c(9)};
}

// @param x in units of the border.
GEOMAP_MULTIVERSION void correct_row(const double* __restrict x, int count,
                                     const std::array<double, kDegree + 1>& polynomial,
                                     std::uint16_t* __restrict millimetres) {
  const std::array<double, kDegree + 1> c = polynomial;
  for (int u = 0; u < count; ++u) {
    const int mm = millimetres[u];
    const double share = c[0] + x[u] * (c[1] + x[u] * (c[2] + x[u] * (c[3] + x[u] * c[4])));
    const double depth = mm * (1.0 + share) + 0.5;  // rounded by what follows
    const bool is_kept = (mm == DepthImage::kNoReading) | (mm == DepthImage::kInvalid) |
                         !(depth > 1.0) | !(depth < 65535.0);
    const int better = static_cast<int>(is_kept ? 0.0 : depth);
    millimetres[u] = static_cast<std::uint16_t>(is_kept ? mm : better);
  }
}

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
                                           const CameraModel& camera) {
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

RgbdFrame corrected(const RgbdFrame& frame, const DepthCorrection& correction) {
  const CameraModel& camera = frame.depth_camera;
  if (!camera.valid() || frame.depth.width != camera.width || frame.depth.height != camera.height ||
      frame.depth.millimetres.size() !=
          static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height)) {
    throw std::invalid_argument("depth correction: depth image and camera disagree");
  }
  RgbdFrame result = frame;
  if (correction.is_none()) return result;
  std::vector<double> x(static_cast<std::size_t>(camera.width));
  for (int u = 0; u < camera.width; ++u) {
    x[static_cast<std::size_t>(u)] = camera.ray(u, 0.0).x() / kBorderX;
  }
  for (int v = 0; v < camera.height; ++v) {
    correct_row(x.data(), camera.width,
                along_row(correction.coefficients(), camera.ray(0.0, v).y()),
                result.depth.millimetres.data() + static_cast<std::ptrdiff_t>(v) * camera.width);
  }
  return result;
}

}  // namespace geomap::geometry
