// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/render_robot.hpp"

#include <cmath>
#include <numbers>

#include "viewer/line_list.hpp"
#include "viewer/surface_mesh.hpp"

namespace geomap::viewer {
namespace {

using Eigen::Vector3d;

constexpr double kRadius = 0.2, kHeight = 0.22;  // [m]
constexpr int kSides = 24;
constexpr Rgba kBodyColor = {0.26F, 0.48F, 0.72F, 1.0F};
constexpr Rgba kEdgeColor = {0.80F, 0.88F, 0.97F, 1.0F};

Vector3d on_rim(int side, double z) {
  const double angle = 2.0 * std::numbers::pi * side / kSides;
  return {kRadius * std::cos(angle), kRadius * std::sin(angle), z};
}

void add_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                  std::vector<Vertex>& triangles) {
  const auto color = bytes_of(shaded(kBodyColor, brightness((b - a).cross(c - a).normalized())));
  for (const Vector3d& corner : {a, b, c}) {
    triangles.push_back({.position = corner.cast<float>(), .color = color, .along = 0.0F});
  }
}

std::vector<Vertex> drum() {
  std::vector<Vertex> triangles;
  for (int i = 0; i < kSides; ++i) {
    const Vector3d low = on_rim(i, 0.0), next_low = on_rim(i + 1, 0.0);
    const Vector3d high = on_rim(i, kHeight), next_high = on_rim(i + 1, kHeight);
    add_triangle(low, next_low, next_high, triangles);
    add_triangle(low, next_high, high, triangles);
    add_triangle({0.0, 0.0, kHeight}, high, next_high, triangles);
    add_triangle(Vector3d::Zero(), next_low, low, triangles);
  }
  return triangles;
}

std::vector<Vertex> edges() {
  std::vector<Vertex> lines;
  for (int i = 0; i < kSides; ++i) {
    for (const double z : {0.0, kHeight})
      add_line(on_rim(i, z), on_rim(i + 1, z), kEdgeColor, lines);
  }
  const Vector3d top(0.0, 0.0, kHeight + 0.005);
  add_arrow(top, top + 2.4 * kRadius * Vector3d::UnitX(), kEdgeColor, lines);
  return lines;
}

}  // namespace

void RenderRobot::draw(const DrawContext& context) {
  const std::optional<Eigen::Isometry3d> T_world_body = context.scene.T_world_body();
  if (!T_world_body) return;
  if (body_.size() == 0) {
    painter_->upload(body_, drum());
    painter_->upload(edges_, edges());
  }
  painter_->fill(context, body_, *T_world_body, {});
  const Rgba tint = context.theme.is_dark ? Rgba{1.0F, 1.0F, 1.0F, 1.0F} : kBodyColor;
  painter_->lines(context, edges_, *T_world_body, {.tint = tint, .width = 2.0F});
}

}  // namespace geomap::viewer
