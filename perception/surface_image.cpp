// SPDX-License-Identifier: BSD-3-Clause
#include "perception/surface_image.hpp"

#include <algorithm>
#include <stdexcept>

#include "perception/surface_rows.hpp"

namespace geomap::perception {
namespace {

constexpr double kFlatRms = 1.5;       // of a window's fit, over sigma
constexpr double kLeastCosine = 0.15;  // |n·ray|: beyond, readings say little of the surface

// Inverse depth of every pixel [1/m], 0 where there is no reading in range, with a frame of two
// empty pixels around the image, so that windows need not look for the border.
class PaddedInverseDepth {
 public:
  static constexpr int kBorder = 2;

  PaddedInverseDepth(const geometry::DepthImage& depth, double min_depth, double max_depth)
      : stride_(depth.width + 2 * kBorder),
        values_(static_cast<std::size_t>(stride_ * (depth.height + 2 * kBorder)), 0.0) {
    for (int v = 0; v < depth.height; ++v) {
      invert_depth(depth.millimetres.data() + v * depth.width, depth.width, 1e3 * min_depth,
                   1e3 * max_depth, values_.data() + index(v));
    }
  }
  const double* row(int v) const { return values_.data() + index(v); }
  int stride() const { return stride_; }

 private:
  int index(int v) const { return (v + kBorder) * stride_ + kBorder; }
  int stride_;
  std::vector<double> values_;
};

// What is held of one row on its way from readings to surfaces.
class RowBuffers {
 public:
  explicit RowBuffers(const geometry::CameraModel& camera)
      : width_(static_cast<std::size_t>(camera.width)), values_(kArrays * width_) {
    for (int u = 0; u < camera.width; ++u) array(0)[u] = camera.ray(u, 0.0).x();
  }
  const double* ray_x() { return array(0); }
  WindowFits fits() { return {array(1), array(2), array(3)}; }
  SurfaceRow surfaces() {
    return {{array(4), array(5), array(6)},
            {array(7), array(8), array(9)},
            {array(10), array(11), array(12)}};
  }

 private:
  static constexpr std::size_t kArrays = 13;
  double* array(std::size_t i) { return values_.data() + i * width_; }
  std::size_t width_;
  std::vector<double> values_;
};

SurfacePixel pixel_of(const SurfaceRow& row, int u) {
  const auto vector = [u](double* const* of) {
    return Eigen::Vector3d(of[0][u], of[1][u], of[2][u]);
  };
  return {vector(row.inverse_depth), vector(row.normal), vector(row.point)};
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
  pixels_.resize(count + 1);
  const PaddedInverseDepth inverse(depth, min_depth, max_depth);
  RowBuffers buffers(camera_);
  const SurfaceRow row = buffers.surfaces();
  for (int v = 0; v < depth.height; ++v) {
    fit_windows(inverse.row(v), inverse.stride(), depth.width, noise, kFlatRms, buffers.fits());
    place_surfaces(buffers.fits(), depth.width, buffers.ray_x(), camera_.ray(0.0, v).y(),
                   camera_.fx, camera_.fy, kLeastCosine, row);
    for (int u = 0; u < depth.width; ++u) {
      SurfacePixel& pixel = pixels_[static_cast<std::size_t>(v * depth.width + u)];
      pixel = pixel_of(row, u);
      if (!pixel.valid()) continue;
      ++valid_;
      farthest_ = std::max(farthest_, pixel.point.z());
    }
  }
}

}  // namespace geomap::perception
