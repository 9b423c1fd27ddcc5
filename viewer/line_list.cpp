// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/line_list.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace geomap::viewer {

std::array<std::uint8_t, 4> bytes_of(const Rgba& color) {
  std::array<std::uint8_t, 4> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<std::uint8_t>(std::clamp(color[i], 0.0F, 1.0F) * 255.0F + 0.5F);
  }
  return bytes;
}

void add_line(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Rgba& color,
              std::vector<Vertex>& lines) {
  const auto bytes = bytes_of(color);
  lines.push_back({.position = from.cast<float>(), .color = bytes, .along = 0.0F});
  lines.push_back({.position = to.cast<float>(),
                   .color = bytes,
                   .along = static_cast<float>((to - from).norm())});
}

void add_arrow(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Rgba& color,
               std::vector<Vertex>& lines) {
  constexpr double kHead = 0.15, kSlimness = 0.35;
  add_line(from, to, color, lines);
  const Eigen::Vector3d back = kHead * (from - to);
  const Eigen::Vector3d aside = kSlimness * back.norm() * back.unitOrthogonal();
  const Eigen::Vector3d upwards = kSlimness * back.cross(aside).normalized() * back.norm();
  for (const Eigen::Vector3d& side : {aside, upwards}) {
    add_line(to, to + back + side, color, lines);
    add_line(to, to + back - side, color, lines);
  }
}

}  // namespace geomap::viewer
