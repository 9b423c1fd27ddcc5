// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/surface_mesh.hpp"

#include "viewer/surface_shape.hpp"

namespace geomap::viewer {

SurfaceMesh::SurfaceMesh(const geometry::PlanarPolygon& surface, Painter& painter) {
  const SurfaceShape shape = shape_of(surface);
  T_world_mesh_ = shape.T_world_shape;
  normal_ = shape.normal;
  middle_ = shape.middle;
  if (shape.empty()) return;
  painter.upload(fill_, shape.triangles);
  painter.upload(outline_, shape.outline);
}

float brightness(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d light = Eigen::Vector3d(0.45, 0.25, 0.85).normalized();
  return static_cast<float>(0.86 + 0.14 * normal.dot(light));
}

Rgba shaded(const Rgba& color, float brightness) {
  return {color[0] * brightness, color[1] * brightness, color[2] * brightness, color[3]};
}

Rgba tinted(const Rgba& color, const Rgba& with, float share) {
  Rgba sum = color;
  for (std::size_t i = 0; i < 3; ++i) sum[i] += share * (with[i] - color[i]);
  return sum;
}

Rgba of_back(const Rgba& front, const Theme& theme) {
  constexpr float kPaler = 0.55F, kThinner = 0.40F;
  const Rgba pale = tinted(front, theme.is_dark ? theme.background : theme.ghost, kPaler);
  return with_alpha(pale, kThinner * front[3]);
}

}  // namespace geomap::viewer
