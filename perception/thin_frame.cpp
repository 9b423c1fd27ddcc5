// SPDX-License-Identifier: BSD-3-Clause
#include "perception/thin_frame.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "perception/thin_blocks.hpp"

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

// Any block, also one that the image's border cuts.
BlockSum sum_block(const geometry::DepthImage& depth, int u, int v, int step) {
  const auto& mm = depth.millimetres;
  const int width = depth.width, radius = step / 2;
  const auto centre = static_cast<std::ptrdiff_t>(v) * width + u;
  const int centre_mm = mm[static_cast<std::size_t>(centre)];
  if (!DepthImage::is_reading(mm[static_cast<std::size_t>(centre)])) return {};
  BlockSum sum{0, 1, 1U << BlockSum::kBeside};
  const auto belongs = [&](std::ptrdiff_t pixel) {
    const std::uint16_t value = mm[static_cast<std::size_t>(pixel)];
    return DepthImage::is_reading(value) && std::abs(value - centre_mm) <= same_surface(centre_mm);
  };
  const auto difference = [&](std::ptrdiff_t pixel) {
    return mm[static_cast<std::size_t>(pixel)] - centre_mm;
  };
  const int bottom = std::min(radius, std::min(v, depth.height - 1 - v));
  const int side = std::min(radius, std::min(u, width - 1 - u));
  for (int dv = 0; dv <= bottom; ++dv) {
    for (int du = dv == 0 ? 1 : -side; du <= side; ++du) {
      const std::ptrdiff_t offset = static_cast<std::ptrdiff_t>(dv) * width + du;
      if (!belongs(centre + offset) || !belongs(centre - offset)) continue;
      sum.differences += difference(centre + offset) + difference(centre - offset);
      sum.pixels += 2;
      if (dv > 0 || du > BlockSum::kBeside) continue;
      const unsigned both = 1U << (BlockSum::kBeside + du) | 1U << (BlockSum::kBeside - du);
      sum.beside = static_cast<std::uint8_t>(sum.beside | both);
    }
  }
  return sum;
}

// The blocks whose centres lie in row v.
void sum_row(const geometry::DepthImage& depth, int v, int step, std::vector<BlockSum>& sums) {
  const int radius = step / 2, count = static_cast<int>(sums.size());
  int done = 0;
  if (v >= radius && v + radius < depth.height) {
    const int spare = depth.width - kBlockLanes;  // columns on which a block may begin, less one
    const int whole = spare < 0 ? 0 : std::min(spare / step + 1, count);
    const std::uint16_t* row =
        depth.millimetres.data() + static_cast<std::ptrdiff_t>(v) * depth.width;
    if (sum_blocks(row + radius, depth.width, step, whole, sums.data())) done = whole;
  }
  for (int k = done; k < count; ++k) {
    sums[static_cast<std::size_t>(k)] = sum_block(depth, k * step + radius, v, step);
  }
}

std::int32_t rounded(std::int32_t sum, std::int32_t count) {
  return (2 * sum + count) / (2 * count);
}

std::uint16_t mean_depth(std::uint16_t centre, const BlockSum& sum) {
  if (sum.pixels == 0) return DepthImage::kNoReading;
  return static_cast<std::uint16_t>(rounded(centre * sum.pixels + sum.differences, sum.pixels));
}

// @param centre three bytes.
void append_mean_color(const std::uint8_t* centre, const BlockSum& sum,
                       std::vector<std::uint8_t>& rgb) {
  std::array<std::int32_t, 3> total{};
  for (unsigned rest = sum.beside; rest != 0; rest &= rest - 1) {
    const std::uint8_t* pixel = centre + 3 * (std::countr_zero(rest) - BlockSum::kBeside);
    for (std::size_t c = 0; c < 3; ++c) total[c] += pixel[c];
  }
  const int count = std::max(1, std::popcount(sum.beside));
  for (const std::int32_t value : total) {
    rgb.push_back(static_cast<std::uint8_t>(rounded(value, count)));
  }
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
  std::vector<BlockSum> sums(static_cast<std::size_t>(thin.depth.width));
  for (int v = step / 2; v < frame.depth.height; v += step) {
    sum_row(frame.depth, v, step, sums);
    auto pixel = static_cast<std::size_t>(v) * static_cast<std::size_t>(frame.depth.width) +
                 static_cast<std::size_t>(step / 2);
    for (const BlockSum& sum : sums) {
      thin.depth.millimetres.push_back(mean_depth(frame.depth.millimetres[pixel], sum));
      if (colored) append_mean_color(&frame.color.rgb[3 * pixel], sum, thin.color.rgb);
      pixel += static_cast<std::size_t>(step);
    }
  }
  return thin;
}

}  // namespace geomap::perception
