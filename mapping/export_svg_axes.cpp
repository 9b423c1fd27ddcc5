// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/export_svg_axes.hpp"

#include <array>
#include <cmath>
#include <string>
#include <string_view>

namespace geomap::mapping {
namespace {

// Towards the eye: a dot in a ring; away from it: a ring.
void draw_axis_end_on(SvgCanvas& canvas, const Eigen::Vector2d& at, const std::string& color,
                      bool towards_eye) {
  canvas.circle(at, 4.0, {.fill = "#ffffff", .stroke = color, .stroke_width = 1.4});
  if (towards_eye) canvas.circle(at, 1.6, {.fill = color});
}

}  // namespace

void draw_axes(SvgCanvas& canvas, const Eigen::Vector2d& origin, const ViewAxes& axes) {
  constexpr std::array<std::string_view, 3> kNames = {"x", "y", "z"};
  constexpr std::array<std::string_view, 3> kColors = {"#c0392b", "#2e8b57", "#2f5fa8"};
  constexpr double kLength = 22.0;
  const bool is_level = std::abs(axes.forward.z()) < 0.05;
  for (int i = 0; i < 3; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    const Eigen::Vector3d world = Eigen::Vector3d::Unit(i);
    const Eigen::Vector2d along = axes.project(world);
    const Eigen::Vector2d tip(along.x(), -along.y());
    if (tip.norm() < 0.15) {
      const bool towards_eye = world.dot(axes.forward) < 0.0;
      draw_axis_end_on(canvas, origin, std::string(kColors[axis]), towards_eye);
      continue;
    }
    canvas.line(origin, origin + kLength * tip, kColors[axis], 1.6);
    Eigen::Vector2d label = origin + kLength * tip + 9.0 * tip.normalized();
    // In a level view x and y lie on one line: their names go above and below it.
    if (is_level && i < 2) label += Eigen::Vector2d(-4.0, i == 0 ? 9.0 : -8.0);
    canvas.text(label + Eigen::Vector2d(0.0, 4.0), kNames[axis],
                {.size = 11.0, .color = kColors[axis], .anchor = TextAnchor::kMiddle});
  }
}

}  // namespace geomap::mapping
