// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/render_keyframe.hpp"

#include <algorithm>

#include "viewer/setting_widgets.hpp"

namespace geomap::viewer {

void RenderKeyframe::draw(const DrawContext& context) {
  const PlanesLayer& layer = context.scene.planes;
  if (stamp_ != layer.stamp) {
    planes_.clear();
    for (const auto& plane : layer.planes) planes_.emplace_back(plane, *painter_);
    stamp_ = layer.stamp;
  }
  for (const SurfaceMesh& mesh : planes_) {
    const Rgba color = with_alpha(color_of_normal(mesh.normal()), static_cast<float>(opacity_));
    painter_->fill(context, mesh.fill(), mesh.T_world_mesh(),
                   {.front = color, .back = of_back(color, context.theme), .writes_depth = false});
  }
  for (const SurfaceMesh& mesh : planes_) {
    const Rgba color = tinted(color_of_normal(mesh.normal()), context.theme.foreground, 0.5F);
    painter_->lines(context, mesh.outline(), mesh.T_world_mesh(), {.tint = color, .width = 2.0F});
  }
}

bool RenderKeyframe::panel() { return slider("Opacity", opacity_, 0.0, 1.0, "%.2f"); }

void RenderKeyframe::load(const Preferences& preferences) {
  opacity_ = std::clamp(preferences.get(name() + ".opacity", opacity_), 0.0, 1.0);
}

void RenderKeyframe::store(Preferences& preferences) const {
  preferences.set(name() + ".opacity", opacity_);
}

}  // namespace geomap::viewer
