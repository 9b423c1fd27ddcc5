// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/render_axes.hpp"

#include <imgui.h>

#include "viewer/line_list.hpp"
#include "viewer/setting_widgets.hpp"

namespace geomap::viewer {
namespace {

constexpr std::array<Rgba, 3> kAxisColors = {
    {{0.93F, 0.30F, 0.26F, 1.0F}, {0.30F, 0.75F, 0.32F, 1.0F}, {0.32F, 0.52F, 0.96F, 1.0F}}};
constexpr Rgba kGravityColor = {0.62F, 0.65F, 0.69F, 1.0F};
constexpr double kGravityShare = 0.6;  // of the length of the axes
constexpr double kBeyond = 1.08;       // where labels stand, against the arrows' ends

}  // namespace

void RenderAxes::draw(const DrawContext& context) {
  const double length = shows_gravity_ ? length_ : -length_;
  if (length != uploaded_length_) {
    std::vector<Vertex> lines;
    for (int axis = 0; axis < 3; ++axis) {
      add_arrow(Eigen::Vector3d::Zero(), length_ * Eigen::Vector3d::Unit(axis),
                kAxisColors[static_cast<std::size_t>(axis)], lines);
    }
    if (shows_gravity_) {
      add_arrow(Eigen::Vector3d::Zero(), -kGravityShare * length_ * Eigen::Vector3d::UnitZ(),
                kGravityColor, lines);
    }
    painter_->upload(lines_, lines);
    uploaded_length_ = length;
  }
  painter_->lines(context, lines_, Eigen::Isometry3d::Identity(), {.width = 2.5F});
}

void RenderAxes::add_labels(const DrawContext&, std::vector<SceneLabel>& labels) {
  constexpr std::array<const char*, 3> kNames = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    labels.push_back({kBeyond * length_ * Eigen::Vector3d::Unit(axis), kNames[i], kAxisColors[i]});
  }
  if (!shows_gravity_) return;
  labels.push_back(
      {-kBeyond * kGravityShare * length_ * Eigen::Vector3d::UnitZ(), "gravity", kGravityColor});
}

bool RenderAxes::panel() {
  const bool is_longer = slider("Length", length_, 0.1, 10.0, "%.1f m");
  const bool is_switched = ImGui::Checkbox("Gravity", &shows_gravity_);
  return is_longer || is_switched;
}

void RenderAxes::load(const Preferences& preferences) {
  length_ = std::clamp(preferences.get(name() + ".length", length_), 0.1, 10.0);
  shows_gravity_ = preferences.get(name() + ".gravity", shows_gravity_);
}

void RenderAxes::store(Preferences& preferences) const {
  preferences.set(name() + ".length", length_);
  preferences.set(name() + ".gravity", shows_gravity_);
}

}  // namespace geomap::viewer
