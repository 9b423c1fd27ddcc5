// SPDX-License-Identifier: BSD-3-Clause
#include "perception/surface_image.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace geomap::perception {
namespace {

constexpr double kSameSurface = 0.06;  // relative depth difference within a window
constexpr double kLeastFill = 0.6;     // of a window
constexpr double kFlatRms = 1.5;       // of a window's fit, over sigma
constexpr double kLeastCosine = 0.15;  // |n·ray|: beyond, readings say little of the surface

struct Window {
  double a = 0.0, b = 0.0;  // slope of inverse depth [1/m per pixel]
  double q = 0.0;           // inverse depth of the plane at the centre [1/m]
};

// Inverse depth of every pixel [1/m], 0 where there is no reading in range, with a frame of two
// empty pixels around the image, so that windows need not look for the border.
class PaddedInverseDepth {
 public:
  static constexpr int kBorder = 2;

  PaddedInverseDepth(const geometry::DepthImage& depth, double min_depth, double max_depth)
      : stride_(depth.width + 2 * kBorder),
        values_(static_cast<std::size_t>(stride_ * (depth.height + 2 * kBorder)), 0.0) {
    const double nearest = 1e3 * min_depth, farthest = 1e3 * max_depth;
    for (int v = 0; v < depth.height; ++v) {
      for (int u = 0; u < depth.width; ++u) {
        const std::uint16_t mm = depth.at(u, v);
        if (geometry::DepthImage::is_reading(mm) && mm >= nearest && mm <= farthest) {
          values_[static_cast<std::size_t>(index(u, v))] = 1e3 / mm;
        }
      }
    }
  }
  const double* at(int u, int v) const { return values_.data() + index(u, v); }
  int stride() const { return stride_; }

 private:
  int index(int u, int v) const { return (v + kBorder) * stride_ + u + kBorder; }
  int stride_;
  std::vector<double> values_;
};

// Least squares over the window's pixels whose depth is close to the centre's.
template <int kRadius>
std::optional<Window> fit_window(const double* centre, int stride, double largest_rms) {
  constexpr double kPixels = (2 * kRadius + 1) * (2 * kRadius + 1);
  const double q0 = *centre, same = kSameSurface * q0;
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0, g = 0, gx = 0, gy = 0, gg = 0;
  for (int dv = -kRadius; dv <= kRadius; ++dv) {
    const double* row = centre + dv * stride;
    for (int du = -kRadius; du <= kRadius; ++du) {
      const double difference = row[du] - q0;
      const double w = std::abs(difference) <= same ? 1.0 : 0.0;  // an absent reading is q = 0
      const double value = w * difference;
      n += w;
      x += w * du;
      y += w * dv;
      xx += w * (du * du);
      xy += w * (du * dv);
      yy += w * (dv * dv);
      g += value;
      gx += value * du;
      gy += value * dv;
      gg += value * difference;
    }
  }
  if (n < kLeastFill * kPixels) return std::nullopt;
  const double mx = x / n, my = y / n, mg = g / n;
  const double cxx = xx - x * mx, cxy = xy - x * my, cyy = yy - y * my;
  const double cgx = gx - g * mx, cgy = gy - g * my, cgg = gg - g * mg;
  const double determinant = cxx * cyy - cxy * cxy;
  if (!(determinant > 1e-3 * cxx * cyy)) return std::nullopt;
  Window fit;
  fit.a = (cgx * cyy - cgy * cxy) / determinant;
  fit.b = (cgy * cxx - cgx * cxy) / determinant;
  const double squares = std::max(0.0, cgg - fit.a * cgx - fit.b * cgy);
  if (squares > (n - 3.0) * largest_rms * largest_rms) return std::nullopt;
  fit.q = q0 + mg - fit.a * mx - fit.b * my;
  return fit.q > 0.0 ? std::optional(fit) : std::nullopt;
}

SurfacePixel surface_of(const Window& fit, const geometry::CameraModel& camera, int u, int v) {
  const Eigen::Vector3d ray = camera.ray(u, v);
  const double a = fit.a * camera.fx, b = fit.b * camera.fy;
  SurfacePixel pixel;
  pixel.inverse_depth = {a, b, fit.q - a * ray.x() - b * ray.y()};
  const Eigen::Vector3d normal = -pixel.inverse_depth.normalized();
  if (std::abs(normal.dot(ray)) < kLeastCosine * ray.norm()) return {};
  pixel.normal = normal;
  pixel.point = ray / fit.q;
  return pixel;
}

}  // namespace

SurfaceImage::SurfaceImage(const geometry::RgbdFrame& frame, double min_depth, double max_depth,
                           const geometry::DepthNoise& noise)
    : camera_(frame.depth_camera) {
  const geometry::DepthImage& depth = frame.depth;
  const auto count = static_cast<std::size_t>(std::max(0, depth.width)) *
                     static_cast<std::size_t>(std::max(0, depth.height));
  if (!camera_.valid() || depth.width != camera_.width || depth.height != camera_.height ||
      depth.millimetres.size() != count) {
    throw std::invalid_argument("surface image: depth image and camera disagree");
  }
  pixels_.resize(count);
  const PaddedInverseDepth inverse(depth, min_depth, max_depth);
  for (int v = 0; v < depth.height; ++v) {
    for (int u = 0; u < depth.width; ++u) {
      const double* centre = inverse.at(u, v);
      if (*centre == 0.0) continue;
      const double z = 1.0 / *centre;
      const double largest_rms = kFlatRms * noise.sigma(z) / (z * z);
      auto fit = fit_window<2>(centre, inverse.stride(), largest_rms);
      if (!fit) fit = fit_window<1>(centre, inverse.stride(), largest_rms);
      if (!fit) continue;
      SurfacePixel& pixel = pixels_[static_cast<std::size_t>(v * depth.width + u)];
      pixel = surface_of(*fit, camera_, u, v);
      if (!pixel.valid()) continue;
      ++valid_;
      farthest_ = std::max(farthest_, pixel.point.z());
    }
  }
}

}  // namespace geomap::perception
