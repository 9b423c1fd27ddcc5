// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/render_vetoes.hpp"

#include <imgui.h>

namespace geomap::viewer {

void RenderVetoes::draw(const DrawContext& context) {
  const MapLayer& map = context.scene.map;
  if (stamp_ != map.stamp) {
    kept_.clear();
    for (const mapping::Veto& veto : map.vetoes) {
      geometry::PlanarPolygon surface = veto.feature.surface;
      surface.polygon = veto.region;
      kept_.push_back({veto.cause, SurfaceMesh(surface, *painter_)});
    }
    stamp_ = map.stamp;
  }
  for (const Kept& kept : kept_) {
    if (kept.cause != mapping::VetoCause::kDeleted && !shows_all) continue;
    painter_->lines(context, kept.mesh.outline(), kept.mesh.T_world_mesh(),
                    {.tint = with_alpha(context.theme.bad, 0.9F),
                     .width = 1.5F,
                     .dash = dash_length(context, kept.mesh.middle())});
  }
}

bool RenderVetoes::panel() { return ImGui::Checkbox("Also held and placed ones", &shows_all); }

void RenderVetoes::load(const Preferences& preferences) {
  shows_all = preferences.get(name() + ".all", shows_all);
}

void RenderVetoes::store(Preferences& preferences) const {
  preferences.set(name() + ".all", shows_all);
}

}  // namespace geomap::viewer
