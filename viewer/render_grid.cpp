// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/render_grid.hpp"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "viewer/line_list.hpp"
#include "viewer/map_level.hpp"

namespace geomap::viewer {
namespace {

constexpr int kHalf = 40;           // lines on each side of the middle
constexpr int kStep = 5;            // spacings between two ends of a line's pieces, for the fading
constexpr double kWidestView = 60;  // distance of the eye in spacings, from which on it is coarser

// White, from the middle to the rim ever less opaque.
Vertex faded(double x, double y, float opacity) {
  const double rim = std::clamp(1.0 - std::hypot(x, y) / kHalf, 0.0, 1.0);
  const float alpha = opacity * static_cast<float>(std::sqrt(rim));
  return {.position = Eigen::Vector3d(x, y, 0.0).cast<float>(),
          .color = bytes_of({1.0F, 1.0F, 1.0F, alpha}),
          .along = 0.0F};
}

std::vector<Vertex> grid_lines(double spacing) {
  std::vector<Vertex> lines;
  for (int i = -kHalf; i <= kHalf; ++i) {
    const float opacity = i % 10 == 0 ? 1.0F : 0.42F;
    for (int along = -kHalf; along < kHalf; along += kStep) {
      lines.push_back(faded(i, along, opacity));
      lines.push_back(faded(i, along + kStep, opacity));
      lines.push_back(faded(along, i, opacity));
      lines.push_back(faded(along + kStep, i, opacity));
    }
  }
  for (Vertex& vertex : lines) vertex.position *= static_cast<float>(spacing);
  return lines;
}

double spacing_for(double distance) {
  return std::pow(10.0, std::max(0.0, std::ceil(std::log10(distance / kWidestView))));
}

}  // namespace

void RenderGrid::draw(const DrawContext& context) {
  const MapLayer& map = context.scene.map;
  if (map_stamp_ != map.stamp) {
    map_level_ = lowest_level(map.features);
    map_stamp_ = map.stamp;
  }
  const Viewpoint& viewpoint = context.camera.viewpoint();
  const double spacing = spacing_for(viewpoint.distance);
  if (spacing != spacing_) {
    painter_->upload(lines_, grid_lines(spacing));
    spacing_ = spacing;
  }
  const Eigen::Vector3d about =
      context.camera.is_first_person() ? context.camera.eye() : viewpoint.target;
  // In steps of the stronger lines, so that the lines stay where they are while the eye moves.
  const Eigen::Vector2d middle = (about.head<2>() / (10.0 * spacing)).array().round();
  Eigen::Isometry3d T_world_grid = Eigen::Isometry3d::Identity();
  T_world_grid.translation().head<2>() = 10.0 * spacing * middle;
  if (is_at_map_) T_world_grid.translation().z() = map_level_;
  // Depth is not written: what lies on the floor is never in conflict with the grid.
  painter_->lines(context, lines_, T_world_grid,
                  {.tint = context.theme.grid, .width = 1.0F, .dash = 0.0, .writes_depth = false});
}

bool RenderGrid::panel() { return ImGui::Checkbox("At the lowest level of the map", &is_at_map_); }

void RenderGrid::load(const Preferences& preferences) {
  is_at_map_ = preferences.get(name() + ".at_map", is_at_map_);
}

void RenderGrid::store(Preferences& preferences) const {
  preferences.set(name() + ".at_map", is_at_map_);
}

}  // namespace geomap::viewer
