// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/render_cloud.hpp"

#include <algorithm>
#include <cmath>

#include "viewer/point_share.hpp"
#include "viewer/setting_widgets.hpp"

namespace geomap::viewer {
namespace {

using geometry::RgbdFrame;

constexpr std::array<std::uint8_t, 3> kNoColor = {170, 176, 184};

// Every how many-th pixel of a row, and every how many-th row, is taken.
int stride_for(const RgbdFrame& frame, std::size_t budget) {
  const double pixels = static_cast<double>(frame.depth.width) * frame.depth.height;
  const double most = static_cast<double>(budget / kCloudShare);
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(pixels / most))));
}

std::array<std::uint8_t, 3> color_at(const RgbdFrame& frame, int u, int v) {
  const bool matches = !frame.color.empty() && frame.color.width == frame.depth.width &&
                       frame.color.height == frame.depth.height;
  if (!matches) return kNoColor;
  const std::size_t at =
      3 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(frame.color.width) +
           static_cast<std::size_t>(u));
  return {frame.color.rgb[at], frame.color.rgb[at + 1], frame.color.rgb[at + 2]};
}

std::vector<ScenePoint> points_of(const RgbdFrame& frame, int stride) {
  std::vector<ScenePoint> points;
  for (int v = stride / 2; v < frame.depth.height; v += stride) {
    for (int u = stride / 2; u < frame.depth.width; u += stride) {
      const std::uint16_t depth = frame.depth.at(u, v);
      if (!geometry::DepthImage::is_reading(depth)) continue;
      points.push_back({.position = frame.depth_camera.point(u, v, 0.001 * depth).cast<float>(),
                        .color = color_at(frame, u, v)});
    }
  }
  return points;
}

}  // namespace

void RenderCloud::draw(const DrawContext& context) {
  const FrameLayer& layer = context.scene.frame;
  if (context.point_budget < kCloudShare || !layer.frame || layer.frame->depth.empty() ||
      !layer.T_world_camera || !layer.frame->depth_camera.valid()) {
    return;
  }
  const int stride = stride_for(*layer.frame, context.point_budget);
  if (stamp_ != layer.stamp || stride_ != stride) {
    painter_->upload(points_, points_of(*layer.frame, stride));
    stamp_ = layer.stamp;
    stride_ = stride;
  }
  painter_->points(context, points_, points_.size(), *layer.T_world_camera,
                   {.size = static_cast<float>(size_)});
}

bool RenderCloud::panel() { return slider("Size", size_, 1.0, 10.0, "%.0f px"); }

void RenderCloud::load(const Preferences& preferences) {
  size_ = std::clamp(preferences.get(name() + ".size", size_), 1.0, 10.0);
}

void RenderCloud::store(Preferences& preferences) const {
  preferences.set(name() + ".size", size_);
}

}  // namespace geomap::viewer
