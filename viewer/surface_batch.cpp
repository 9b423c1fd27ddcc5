// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/surface_batch.hpp"

#include <algorithm>

namespace geomap::viewer {
namespace {

// In the midst of most, so that a few far away do not take from the precision of the others.
Eigen::Vector3d median_middle(std::span<const SurfaceShape* const> shapes) {
  Eigen::Vector3d median = Eigen::Vector3d::Zero();
  std::vector<double> values;
  for (int axis = 0; axis < 3; ++axis) {
    values.clear();
    for (const SurfaceShape* shape : shapes) {
      if (!shape->empty()) values.push_back(shape->middle[axis]);
    }
    if (values.empty()) return median;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), at, values.end());
    median[axis] = *at;
  }
  return median;
}

VertexRange add(const std::vector<Vertex>& added, const Eigen::Isometry3d& T_batch_shape,
                std::uint32_t surface, std::vector<Vertex>& vertices) {
  const VertexRange range{static_cast<int>(vertices.size()), static_cast<int>(added.size())};
  for (Vertex vertex : added) {
    vertex.position = (T_batch_shape * vertex.position.cast<double>()).cast<float>();
    vertex.surface = surface;
    vertices.push_back(vertex);
  }
  return range;
}

}  // namespace

void SurfaceBatch::set(std::span<const SurfaceShape* const> shapes, Painter& painter) {
  const Eigen::Vector3d origin = median_middle(shapes);
  T_world_batch_ = Eigen::Translation3d(origin);
  parts_.clear();
  std::vector<Vertex> vertices;
  for (const SurfaceShape* shape : shapes) {
    const auto surface = static_cast<std::uint32_t>(parts_.size());
    const Eigen::Isometry3d T_batch_shape = Eigen::Translation3d(-origin) * shape->T_world_shape;
    parts_.push_back({.faces = add(shape->triangles, T_batch_shape, surface, vertices),
                      .outline = add(shape->outline, T_batch_shape, surface, vertices)});
  }
  painter.upload(buffer_, vertices);
}

}  // namespace geomap::viewer
