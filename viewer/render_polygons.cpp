// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/render_polygons.hpp"

#include <algorithm>
#include <utility>

#include "viewer/surface_mesh.hpp"

namespace geomap::viewer {
namespace {

using mapping::FeatureId;

constexpr float kOutline = 1.5F, kHeldOutline = 3.0F, kMarkedOutline = 3.5F;  // widths [px]
constexpr float kSelectedTint = 0.45F, kHoveredTint = 0.22F;                  // shares
constexpr float kGhostFill = 0.10F;                                           // opacity
constexpr double kOpaque = 0.995;
// Each run costs two calls. Up to so many surfaces are drawn one by one; of more, a few that are
// neighbours in depth are drawn together, all faces before all outlines, which no eye tells.
constexpr std::size_t kMostRuns = 192;

bool is_selected(const DrawContext& context, const FeatureId& id) {
  return context.selection.selected.contains(id);
}

bool faces_eye(const DrawContext& context, const Eigen::Vector3d& middle,
               const Eigen::Vector3d& normal) {
  const ViewCamera& camera = context.camera;
  const Eigen::Vector3d to_eye =
      camera.is_orthographic() ? (-camera.forward()).eval() : camera.eye() - middle;
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

Rgba marked(const DrawContext& context, const FeatureId& id, const Rgba& color) {
  const Theme& theme = context.theme;
  if (is_selected(context, id)) return tinted(color, theme.selected, kSelectedTint);
  if (context.selection.hovered == id) return tinted(color, theme.hovered, kHoveredTint);
  return color;
}

// Lines stand out against their own fill: towards white in the dark, towards black in the light.
void style_outline(const DrawContext& context, const mapping::ViewFeature& feature,
                   const Rgba& color, bool faces, SurfaceStyle& style) {
  const Theme& theme = context.theme;
  style.outline = with_alpha(tinted(color, theme.foreground, 0.45F), faces ? 0.95F : 0.5F);
  style.width = feature.locked ? kHeldOutline : kOutline;
  const bool is_chosen = is_selected(context, feature.id);
  if (!is_chosen && context.selection.hovered != feature.id) return;
  style.outline = is_chosen ? theme.selected : theme.hovered;
  style.width = kMarkedOutline;
}

}  // namespace

void RenderPolygons::update(const MapLayer& map) {
  if (stamp_ == map.stamp) return;
  stamp_ = map.stamp;
  bool is_changed = std::erase_if(kept_, [&](const auto& kept) {
                      return !map.features.contains(kept.first);
                    }) > 0;
  int number = 0;
  for (const auto& [id, feature] : map.features) {
    ++number;
    auto at = kept_.find(id);
    if (at == kept_.end() || at->second.feature != feature) {
      Kept kept{.feature = feature, .shape = shape_of(mapping::surface_of(feature))};
      at = kept_.insert_or_assign(id, std::move(kept)).first;
      ++shapes_made_;
      is_changed = true;
    }
    at->second.number = number;
  }
  colors_.update(map.features);
  if (!is_changed) return;
  std::vector<const SurfaceShape*> shapes;
  for (const auto& [id, kept] : kept_) shapes.push_back(&kept.shape);
  batch_.set(shapes, *painter_);
}

std::vector<RenderPolygons::Piece> RenderPolygons::pieces(const DrawContext& context) const {
  const Eigen::Vector3d eye = context.camera.eye(), forward = context.camera.forward();
  std::vector<Piece> pieces;
  const auto add = [&](const Kept& kept, const Eigen::Isometry3d& T_world_moved, Piece::Kind kind) {
    const Eigen::Vector3d middle = T_world_moved * kept.shape.middle;
    pieces.push_back({.kept = &kept,
                      .kind = kind,
                      .T_world_batch = T_world_moved * batch_.T_world_batch(),
                      .middle = middle,
                      .normal = T_world_moved.linear() * kept.shape.normal,
                      .depth = forward.dot(middle - eye)});
  };
  for (const auto& [id, kept] : kept_) {
    if (kept.shape.empty()) continue;
    const std::optional<Eigen::Isometry3d> moved = motion_of(context.selection, id);
    const bool goes = context.selection.pending.contains(id);
    add(kept, Eigen::Isometry3d::Identity(),
        moved || goes ? Piece::Kind::kGhost : Piece::Kind::kPlain);
    if (moved && moved->matrix().allFinite()) add(kept, *moved, Piece::Kind::kMoved);
  }
  // Back to front, as blending needs it; by id where that leaves the order open.
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Piece& a, const Piece& b) { return a.depth > b.depth; });
  return pieces;
}

void RenderPolygons::draw(const DrawContext& context) {
  update(context.scene.map);
  const std::vector<Piece> all = pieces(context);
  draw_back_to_front(context, all);
  // What the operator has to see comes last, so that nothing see-through pales it.
  SurfaceRun marked_outlines;
  for (const Piece& piece : all) {
    const FeatureId& id = piece.kept->feature.id;
    const bool is_marked = is_selected(context, id) || context.selection.hovered == id;
    if (piece.kind == Piece::Kind::kGhost) draw_ghost(context, piece);
    if (piece.kind == Piece::Kind::kMoved && is_marked) draw_moved_outline(context, piece);
    if (piece.kind != Piece::Kind::kPlain || !is_marked) continue;
    marked_outlines.outlines.add(batch_[piece.kept->part()].outline);
  }
  if (marked_outlines.outlines.empty()) return;
  painter_->surfaces(context, batch_.buffer(), {&marked_outlines, 1}, batch_.T_world_batch(), {},
                     false);
}

SurfaceStyle RenderPolygons::style_of(const DrawContext& context, const Piece& piece) const {
  const mapping::ViewFeature& feature = piece.kept->feature;
  const Rgba plain = marked(context, feature.id, colors_(color, feature));
  SurfaceStyle style;
  style.front = with_alpha(shaded(plain, brightness(piece.normal)), static_cast<float>(opacity));
  style.back = of_back(style.front, context.theme);
  style_outline(context, feature, plain, faces_eye(context, piece.middle, piece.normal), style);
  return style;
}

void RenderPolygons::draw_back_to_front(const DrawContext& context,
                                        const std::vector<Piece>& pieces) {
  std::vector<SurfaceStyle> styles(batch_.size());
  for (const Piece& piece : pieces) {
    if (piece.kind != Piece::Kind::kPlain) continue;
    styles[piece.kept->part()] = style_of(context, piece);
  }
  std::vector<SurfaceRun> runs;
  const std::size_t most = 1 + pieces.size() / kMostRuns;
  std::size_t in_run = most;
  const auto draw_runs = [&] {
    painter_->surfaces(context, batch_.buffer(), runs, batch_.T_world_batch(), styles,
                       opacity > kOpaque);
    if (!runs.empty()) styles.clear();  // they are on the graphics card now
    runs.clear();
    in_run = most;
  };
  for (const Piece& piece : pieces) {
    if (piece.kind == Piece::Kind::kMoved) {
      draw_runs();
      draw_moved(context, piece);
    }
    if (piece.kind != Piece::Kind::kPlain) continue;
    if (in_run == most) {
      runs.emplace_back();
      in_run = 0;
    }
    ++in_run;
    runs.back().faces.add(batch_[piece.kept->part()].faces);
    runs.back().outlines.add(batch_[piece.kept->part()].outline);
  }
  draw_runs();
}

void RenderPolygons::draw_moved(const DrawContext& context, const Piece& piece) {
  const SurfaceStyle style = style_of(context, piece);
  painter_->fill(context, batch_.buffer(), VertexRanges(batch_[piece.kept->part()].faces),
                 piece.T_world_batch,
                 {.front = style.front, .back = style.back, .writes_depth = opacity > kOpaque});
  draw_moved_outline(context, piece);
}

void RenderPolygons::draw_moved_outline(const DrawContext& context, const Piece& piece) {
  const SurfaceStyle style = style_of(context, piece);
  painter_->lines(context, batch_.buffer(), VertexRanges(batch_[piece.kept->part()].outline),
                  piece.T_world_batch, {.tint = style.outline, .width = style.width});
}

void RenderPolygons::draw_ghost(const DrawContext& context, const Piece& piece) {
  const SurfaceBatch::Part& part = batch_[piece.kept->part()];
  const Rgba ghost = context.theme.ghost;
  const Rgba fill = with_alpha(ghost, kGhostFill);
  painter_->fill(context, batch_.buffer(), VertexRanges(part.faces), piece.T_world_batch,
                 {.front = fill, .back = fill, .writes_depth = false});
  painter_->lines(context, batch_.buffer(), VertexRanges(part.outline), piece.T_world_batch,
                  {.tint = ghost, .width = 2.0F, .dash = dash_length(context, piece.middle)});
}

void RenderPolygons::add_labels(const DrawContext& context, std::vector<SceneLabel>& labels) {
  if (label == Label::kNone) return;
  update(context.scene.map);
  for (const auto& [id, kept] : kept_) {
    std::string text = label == Label::kLabel    ? kept.feature.label
                       : label == Label::kNumber ? std::to_string(kept.number)
                                                 : to_string(id);
    if (text.empty() || kept.shape.empty()) continue;
    const Eigen::Isometry3d T_world_moved =
        motion_of(context.selection, id).value_or(Eigen::Isometry3d::Identity());
    const Eigen::Vector3d middle = T_world_moved * kept.shape.middle;
    const bool faces = faces_eye(context, middle, T_world_moved.linear() * kept.shape.normal);
    const Rgba& text_color =
        is_selected(context, id) ? context.theme.selected : context.theme.foreground;
    labels.push_back({middle, std::move(text), with_alpha(text_color, faces ? 1.0F : 0.5F)});
  }
}

}  // namespace geomap::viewer
