// SPDX-License-Identifier: BSD-3-Clause
#include "perception/thin_frame.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>

namespace geomap::perception {
namespace {

using geometry::CameraModel;
using geometry::DepthImage;
using geometry::RgbdFrame;

int kept(int size, int step) { return (size - step / 2 + step - 1) / step; }

std::size_t bytes_kept(const RgbdFrame& frame, int step, bool colored) {
  return static_cast<std::size_t>(kept(frame.depth.width, step)) *
         static_cast<std::size_t>(kept(frame.depth.height, step)) * (colored ? 5U : 2U);
}

CameraModel thin_camera(const CameraModel& camera, int step) {
  const double offset = step / 2;
  return {kept(camera.width, step), kept(camera.height, step),   camera.fx / step,
          camera.fy / step,         (camera.cx - offset) / step, (camera.cy - offset) / step};
}

void check(const RgbdFrame& frame, std::size_t max_bytes) {
  const auto pixels =
      static_cast<std::size_t>(frame.depth.width) * static_cast<std::size_t>(frame.depth.height);
  if (frame.depth.millimetres.size() != pixels || frame.depth.width != frame.depth_camera.width ||
      frame.depth.height != frame.depth_camera.height) {
    throw std::invalid_argument("thin_frame: sizes of depth image and camera disagree");
  }
  if (!frame.color.empty() &&
      frame.color.rgb.size() != 3 * static_cast<std::size_t>(frame.color.width) *
                                    static_cast<std::size_t>(frame.color.height)) {
    throw std::invalid_argument("thin_frame: colour image has the wrong number of bytes");
  }
  if (max_bytes < 5) throw std::invalid_argument("thin_frame: max_bytes is less than one pixel");
}

/// Sums over the pixels of one block that lie on the surface of its centre.
struct BlockSums {
  std::int64_t depth = 0;
  std::array<std::int64_t, 3> color{};
  std::int64_t pixels = 0;

  void add(const RgbdFrame& frame, std::size_t pixel, bool colored) {
    depth += frame.depth.millimetres[pixel];
    ++pixels;
    if (!colored) return;
    for (std::size_t c = 0; c < 3; ++c) color[c] += frame.color.rgb[3 * pixel + c];
  }
  static std::int64_t rounded(std::int64_t sum, std::int64_t count) {
    return (2 * sum + count) / (2 * count);
  }
};

BlockSums sum_block(const RgbdFrame& frame, int u, int v, int step, bool colored) {
  const auto& mm = frame.depth.millimetres;
  const int width = frame.depth.width;
  const auto centre = static_cast<std::size_t>(v * width + u);
  BlockSums sums;
  if (!DepthImage::is_reading(mm[centre])) return sums;
  sums.add(frame, centre, colored);
  // A plane seen at 70 degrees changes by 1.5 % over three pixels of a Kinect.
  const int same_surface = 10 + mm[centre] / 64;  // [mm]
  const auto belongs = [&](std::uint16_t value) {
    return DepthImage::is_reading(value) && std::abs(value - mm[centre]) <= same_surface;
  };
  const int radius = step / 2;
  const int bottom = std::min(radius, std::min(v, frame.depth.height - 1 - v));
  const int side = std::min(radius, std::min(u, width - 1 - u));
  for (int dv = 0; dv <= bottom; ++dv) {
    for (int du = dv == 0 ? 1 : -side; du <= side; ++du) {
      const auto offset = static_cast<std::ptrdiff_t>(dv) * width + du;
      const auto pixel = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(centre) + offset);
      const auto mirrored = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(centre) - offset);
      if (!belongs(mm[pixel]) || !belongs(mm[mirrored])) continue;
      sums.add(frame, pixel, colored);
      sums.add(frame, mirrored, colored);
    }
  }
  return sums;
}

}  // namespace

RgbdFrame thin_frame(const RgbdFrame& frame, std::size_t max_bytes) {
  check(frame, max_bytes);
  const bool colored = frame.color.width == frame.depth.width &&
                       frame.color.height == frame.depth.height && !frame.color.empty();
  int step = 1;
  while (bytes_kept(frame, step, colored) > max_bytes) step += 2;
  if (step == 1) return frame;

  RgbdFrame thin;
  thin.utime = frame.utime;
  thin.sequence = frame.sequence;
  thin.sensor = frame.sensor;
  thin.depth_camera = thin.color_camera = thin_camera(frame.depth_camera, step);
  thin.depth.width = thin.depth_camera.width;
  thin.depth.height = thin.depth_camera.height;
  thin.depth.millimetres.reserve(bytes_kept(frame, step, false) / 2);
  if (colored) {
    thin.color.width = thin.depth.width;
    thin.color.height = thin.depth.height;
    thin.color.rgb.reserve(thin.depth.millimetres.capacity() * 3);
  }
  for (int v = step / 2; v < frame.depth.height; v += step) {
    for (int u = step / 2; u < frame.depth.width; u += step) {
      const BlockSums sums = sum_block(frame, u, v, step, colored);
      const std::int64_t n = std::max<std::int64_t>(sums.pixels, 1);
      thin.depth.millimetres.push_back(
          static_cast<std::uint16_t>(BlockSums::rounded(sums.depth, n)));
      for (std::size_t c = 0; c < (colored ? 3U : 0U); ++c) {
        thin.color.rgb.push_back(static_cast<std::uint8_t>(BlockSums::rounded(sums.color[c], n)));
      }
    }
  }
  return thin;
}

}  // namespace geomap::perception
