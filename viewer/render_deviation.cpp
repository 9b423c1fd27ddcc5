// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/render_deviation.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "viewer/plane_deviation.hpp"
#include "viewer/setting_widgets.hpp"

namespace geomap::viewer {
namespace {

constexpr float kOpacity = 0.75F;

Rgba color_for(const std::optional<double>& distance, double most, const Theme& theme) {
  return distance ? ramp(*distance / most) : theme.ghost;
}

}  // namespace

void RenderDeviation::draw(const DrawContext& context) {
  const SceneModel& scene = context.scene;
  if (planes_stamp_ != scene.planes.stamp || map_stamp_ != scene.map.stamp) {
    planes_.clear();
    for (const auto& plane : scene.planes.planes) {
      SurfaceMesh mesh(plane, *painter_);
      if (mesh.empty()) continue;
      planes_.push_back({std::move(mesh), distance_from_map(plane, scene.map.features)});
    }
    planes_stamp_ = scene.planes.stamp;
    map_stamp_ = scene.map.stamp;
  }
  for (const Compared& plane : planes_) {
    const Rgba color = color_for(plane.distance, most_, context.theme);
    const SurfaceMesh& mesh = plane.mesh;
    const Rgba fill = with_alpha(color, kOpacity);
    painter_->fill(context, mesh.fill(), mesh.T_world_mesh(),
                   {.front = fill, .back = of_back(fill, context.theme), .writes_depth = false});
    painter_->lines(context, mesh.outline(), mesh.T_world_mesh(), {.tint = color, .width = 2.0F});
  }
}

void RenderDeviation::add_labels(const DrawContext& context, std::vector<SceneLabel>& labels) {
  for (const Compared& plane : planes_) {
    labels.push_back({plane.mesh.middle(),
                      plane.distance ? fmt::format("{:.0f} mm", 1e3 * *plane.distance) : "new",
                      context.theme.foreground});
  }
}

bool RenderDeviation::panel() {
  const bool is_changed = slider("Full scale", most_, 0.005, 0.3, "%.3f m");
  constexpr int kSteps = 12;
  for (int i = 0; i < kSteps; ++i) {
    const Rgba color = ramp(static_cast<double>(i) / (kSteps - 1));
    if (i > 0) ImGui::SameLine(0.0F, 0.0F);
    ImGui::PushID(i);
    ImGui::ColorButton("##ramp", {color[0], color[1], color[2], 1.0F},
                       ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoBorder, {14.0F, 8.0F});
    ImGui::PopID();
  }
  ImGui::TextDisabled("0 to %.0f mm; grey: not in the map", 1e3 * most_);
  return is_changed;
}

void RenderDeviation::load(const Preferences& preferences) {
  most_ = std::clamp(preferences.get(name() + ".full_scale", most_), 0.005, 0.3);
}

void RenderDeviation::store(Preferences& preferences) const {
  preferences.set(name() + ".full_scale", most_);
}

}  // namespace geomap::viewer
