// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/render_points.hpp"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "viewer/point_share.hpp"
#include "viewer/setting_widgets.hpp"

namespace geomap::viewer {
namespace {

// Points scatter about the surface that they lie on: it is drawn over those that are in front of it
// by less than this [m]. Polygons are what a map is for; points are their background.
constexpr double kSetback = 0.06;

// Relative to the middle of the block: small numbers, wherever the block is in the world.
std::vector<ScenePoint> relative_to(const Eigen::Vector3d& origin,
                                    const std::vector<ScenePoint>& points) {
  std::vector<ScenePoint> moved = points;
  for (ScenePoint& point : moved) {
    point.position = (point.position.cast<double>() - origin).cast<float>();
  }
  return moved;
}

// A block takes up less of the picture with the square of its distance. An orthographic view knows
// no distance.
double weight_of(const Eigen::AlignedBox3d& box, const ViewCamera& camera) {
  if (camera.is_orthographic()) return 1.0;
  constexpr double kNearest = 1.0, kFarthest = 1e6;  // [m]
  const double distance = std::clamp(box.exteriorDistance(camera.eye()), kNearest, kFarthest);
  if (!std::isfinite(distance)) return 1.0 / (kFarthest * kFarthest);
  return 1.0 / (distance * distance);
}

}  // namespace

void RenderPoints::update(const PointLayer& layer) {
  if (stamp_ == layer.stamp) return;
  stamp_ = layer.stamp;
  std::erase_if(blocks_, [&](const auto& kept) { return !layer.blocks.contains(kept.first); });
  held_ = 0;
  Eigen::AlignedBox3d bounds;
  for (const auto& [key, block] : layer.blocks) {
    if (!block.points) continue;
    held_ += block.points->size();
    bounds.extend(block.box);
    const auto [at, is_new] = blocks_.try_emplace(key);
    Block& kept = at->second;
    if (!is_new && kept.stamp == block.stamp) continue;
    const Eigen::Vector3d origin =
        block.box.isEmpty() ? Eigen::Vector3d::Zero().eval() : block.box.center();
    kept.T_world_block = Eigen::Translation3d(origin);
    kept.box = block.box;
    kept.stamp = block.stamp;
    painter_->upload(kept.points, relative_to(origin, *block.points));
  }
  if (bounds.isEmpty()) return;
  low_ = bounds.min().z();
  high_ = bounds.max().z();
}

void RenderPoints::draw(const DrawContext& context) {
  update(context.scene.points);
  std::vector<const Block*> seen;
  std::vector<PointClaim> claims;
  const Eigen::Matrix4d clip_from_world = context.camera.view_projection();
  for (const auto& [key, block] : blocks_) {
    if (!may_be_seen(clip_from_world, block.box)) continue;
    seen.push_back(&block);
    claims.push_back({block.points.size(), weight_of(block.box, context.camera)});
  }
  PointStyle style{.size = static_cast<float>(size_),
                   .is_round = is_round_,
                   .veil = with_alpha(context.theme.background, static_cast<float>(paleness_)),
                   .setback = kSetback};
  if (is_by_height_) style.heights = PointStyle::Heights{.low = low_, .high = high_};
  if (hides_above_) style.hidden_above = hide_height_;
  const auto counts =
      share_points(claims, context.point_budget - context.point_budget / kCloudShare);
  drawn_ = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    painter_->points(context, seen[i]->points, counts[i], seen[i]->T_world_block, style);
    drawn_ += counts[i];
  }
}

bool RenderPoints::panel() {
  bool is_changed = slider("Size", size_, 1.0, 10.0, "%.0f px");
  is_changed |= slider("Paleness", paleness_, 0.0, 0.9, "%.2f");
  is_changed |= ImGui::Checkbox("Round", &is_round_);
  is_changed |= ImGui::Checkbox("Colour by height", &is_by_height_);
  is_changed |= ImGui::Checkbox("Hide what is above", &hides_above_);
  if (hides_above_) is_changed |= slider("Height", hide_height_, low_, high_, "%.1f m");
  ImGui::TextDisabled("%zu of %zu points drawn", drawn_, held_);
  return is_changed;
}

void RenderPoints::load(const Preferences& preferences) {
  size_ = std::clamp(preferences.get(name() + ".size", size_), 1.0, 10.0);
  paleness_ = std::clamp(preferences.get(name() + ".paleness", paleness_), 0.0, 0.9);
  is_round_ = preferences.get(name() + ".round", is_round_);
  is_by_height_ = preferences.get(name() + ".by_height", is_by_height_);
  hides_above_ = preferences.get(name() + ".hides_above", hides_above_);
  hide_height_ = preferences.get(name() + ".hide_height", hide_height_);
}

void RenderPoints::store(Preferences& preferences) const {
  preferences.set(name() + ".size", size_);
  preferences.set(name() + ".paleness", paleness_);
  preferences.set(name() + ".round", is_round_);
  preferences.set(name() + ".by_height", is_by_height_);
  preferences.set(name() + ".hides_above", hides_above_);
  preferences.set(name() + ".hide_height", hide_height_);
}

}  // namespace geomap::viewer
