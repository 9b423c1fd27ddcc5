// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/render_vetoes.hpp"

#include <imgui.h>

#include <map>
#include <utility>

namespace geomap::viewer {

void RenderVetoes::update(const MapLayer& map) {
  if (stamp_ == map.veto_stamp) return;
  stamp_ = map.veto_stamp;
  kept_.clear();
  std::vector<SurfaceShape> shapes;
  for (const mapping::Veto& veto : map.vetoes) {
    geometry::PlanarPolygon surface = veto.feature.surface;
    surface.polygon = veto.region;
    SurfaceShape shape = outline_shape_of(surface);
    if (shape.empty()) continue;
    kept_.push_back({veto.cause, shape.middle});
    shapes.push_back(std::move(shape));
  }
  std::vector<const SurfaceShape*> each;
  for (const SurfaceShape& shape : shapes) each.push_back(&shape);
  batch_.set(each, *painter_);
}

void RenderVetoes::draw(const DrawContext& context) {
  update(context.scene.map);
  // Dashes come in few lengths, so that all outlines are drawn in a few calls.
  std::map<double, VertexRanges> outlines;
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    if (kept_[i].cause != mapping::VetoCause::kDeleted && !shows_all) continue;
    outlines[dash_length(context, kept_[i].middle)].add(batch_[i].outline);
  }
  for (const auto& [dash, ranges] : outlines) {
    painter_->lines(context, batch_.buffer(), ranges, batch_.T_world_batch(),
                    {.tint = with_alpha(context.theme.bad, 0.9F), .width = 1.5F, .dash = dash});
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
