// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/render_polygons.hpp"

#include <algorithm>

namespace geomap::viewer {
namespace {

using mapping::FeatureId;

constexpr float kOutline = 1.5F, kHeldOutline = 3.0F, kMarkedOutline = 3.5F;  // widths [px]
constexpr float kSelectedTint = 0.45F, kHoveredTint = 0.22F;                  // shares
constexpr float kGhostFill = 0.10F;                                           // opacity
constexpr double kOpaque = 0.995;

bool is_selected(const DrawContext& context, const FeatureId& id) {
  return context.selection.selected.contains(id);
}

bool faces_eye(const DrawContext& context, const Eigen::Vector3d& middle,
               const Eigen::Vector3d& normal) {
  const ViewCamera& camera = context.camera;
  const bool is_parallel =
      camera.viewpoint().projection == Projection::kOrthographic && !camera.is_first_person();
  const Eigen::Vector3d to_eye = is_parallel ? (-camera.forward()).eval() : camera.eye() - middle;
  return to_eye.dot(normal) > 0.0;
}

// How far the operator has moved a feature so far; nothing: it is where the map has it.
std::optional<Eigen::Isometry3d> motion_of(const Selection& selection, const FeatureId& id) {
  std::optional<Eigen::Isometry3d> moved;
  for (const Selection::Motion& motion : selection.motions) {
    if (!motion.targets.contains(id)) continue;
    moved = motion.T_world_moved * moved.value_or(Eigen::Isometry3d::Identity());
  }
  return moved;
}

// Lines stand out against their own fill: towards white in the dark, towards black in the light.
LineStyle outline_of(const DrawContext& context, const mapping::ViewFeature& feature,
                     const Rgba& color, bool faces) {
  const Theme& theme = context.theme;
  const bool is_hovered = context.selection.hovered == feature.id;
  LineStyle style{.tint = with_alpha(tinted(color, theme.foreground, 0.45F), faces ? 0.95F : 0.5F),
                  .width = feature.locked ? kHeldOutline : kOutline};
  if (is_hovered) style = {.tint = theme.hovered, .width = kMarkedOutline};
  if (is_selected(context, feature.id)) style = {.tint = theme.selected, .width = kMarkedOutline};
  return style;
}

Rgba marked(const DrawContext& context, const FeatureId& id, const Rgba& color) {
  const Theme& theme = context.theme;
  if (is_selected(context, id)) return tinted(color, theme.selected, kSelectedTint);
  if (context.selection.hovered == id) return tinted(color, theme.hovered, kHoveredTint);
  return color;
}

}  // namespace

void RenderPolygons::update(const MapLayer& map) {
  if (stamp_ == map.stamp) return;
  stamp_ = map.stamp;
  std::erase_if(kept_, [&](const auto& kept) { return !map.features.contains(kept.first); });
  int number = 0;
  for (const auto& [id, feature] : map.features) {
    ++number;
    auto at = kept_.find(id);
    if (at == kept_.end() || at->second.feature != feature) {
      Kept kept{feature, SurfaceMesh(mapping::surface_of(feature), *painter_)};
      at = kept_.insert_or_assign(id, std::move(kept)).first;
    }
    at->second.number = number;
  }
  colors_.update(map.features);
}

std::vector<RenderPolygons::Piece> RenderPolygons::pieces(const DrawContext& context) const {
  const Eigen::Vector3d eye = context.camera.eye(), forward = context.camera.forward();
  std::vector<Piece> pieces;
  const auto add = [&](const Kept& kept, const Eigen::Isometry3d& T_world_moved, bool is_ghost) {
    const Eigen::Vector3d middle = T_world_moved * kept.mesh.middle();
    pieces.push_back({.kept = &kept,
                      .T_world_mesh = T_world_moved * kept.mesh.T_world_mesh(),
                      .middle = middle,
                      .normal = T_world_moved.linear() * kept.mesh.normal(),
                      .is_ghost = is_ghost,
                      .depth = forward.dot(middle - eye)});
  };
  for (const auto& [id, kept] : kept_) {
    const std::optional<Eigen::Isometry3d> moved = motion_of(context.selection, id);
    const bool goes = context.selection.pending.contains(id);
    add(kept, Eigen::Isometry3d::Identity(), moved || goes);
    if (moved) add(kept, *moved, false);
  }
  // Back to front, as blending needs it; by id where that leaves the order open.
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Piece& a, const Piece& b) { return a.depth > b.depth; });
  return pieces;
}

void RenderPolygons::draw(const DrawContext& context) {
  update(context.scene.map);
  const std::vector<Piece> all = pieces(context);
  for (const Piece& piece : all) {
    if (!piece.is_ghost) draw_piece(context, piece);
  }
  // What the operator has to see comes last, so that nothing see-through pales it.
  for (const Piece& piece : all) {
    const FeatureId& id = piece.kept->feature.id;
    if (piece.is_ghost) {
      draw_ghost(context, piece);
    } else if (is_selected(context, id) || context.selection.hovered == id) {
      draw_outline(context, piece);
    }
  }
}

void RenderPolygons::draw_piece(const DrawContext& context, const Piece& piece) {
  const mapping::ViewFeature& feature = piece.kept->feature;
  const Rgba plain = marked(context, feature.id, colors_(color, feature));
  const Rgba front =
      with_alpha(shaded(plain, brightness(piece.normal)), static_cast<float>(opacity));
  painter_->fill(
      context, piece.kept->mesh.fill(), piece.T_world_mesh,
      {.front = front, .back = of_back(front, context.theme), .writes_depth = opacity > kOpaque});
  draw_outline(context, piece);
}

void RenderPolygons::draw_outline(const DrawContext& context, const Piece& piece) {
  const mapping::ViewFeature& feature = piece.kept->feature;
  const Rgba plain = marked(context, feature.id, colors_(color, feature));
  const bool faces = faces_eye(context, piece.middle, piece.normal);
  painter_->lines(context, piece.kept->mesh.outline(), piece.T_world_mesh,
                  outline_of(context, feature, plain, faces));
}

void RenderPolygons::draw_ghost(const DrawContext& context, const Piece& piece) {
  const SurfaceMesh& mesh = piece.kept->mesh;
  const Rgba ghost = context.theme.ghost;
  const Rgba fill = with_alpha(ghost, kGhostFill);
  painter_->fill(context, mesh.fill(), piece.T_world_mesh,
                 {.front = fill, .back = fill, .writes_depth = false});
  painter_->lines(context, mesh.outline(), piece.T_world_mesh,
                  {.tint = ghost, .width = 2.0F, .dash = dash_length(context, mesh.middle())});
}

void RenderPolygons::add_labels(const DrawContext& context, std::vector<SceneLabel>& labels) {
  if (label == Label::kNone) return;
  update(context.scene.map);
  for (const auto& [id, kept] : kept_) {
    std::string text = label == Label::kLabel    ? kept.feature.label
                       : label == Label::kNumber ? std::to_string(kept.number)
                                                 : to_string(id);
    if (text.empty()) continue;
    const Eigen::Isometry3d T_world_moved =
        motion_of(context.selection, id).value_or(Eigen::Isometry3d::Identity());
    const Eigen::Vector3d middle = T_world_moved * kept.mesh.middle();
    const bool faces = faces_eye(context, middle, T_world_moved.linear() * kept.mesh.normal());
    const Rgba& text_color =
        is_selected(context, id) ? context.theme.selected : context.theme.foreground;
    labels.push_back({middle, std::move(text), with_alpha(text_color, faces ? 1.0F : 0.5F)});
  }
}

}  // namespace geomap::viewer
