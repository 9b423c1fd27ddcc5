// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/surface_shape.hpp"

#include <algorithm>
#include <utility>

#include "geometry/triangulate.hpp"

namespace geomap::viewer {
namespace {

using geometry::GridPoint;
using geometry::Ring;

// A point in the frame of the polygon: z is not zero where the plane is turned against the frame.
class ToMesh {
 public:
  explicit ToMesh(const geometry::PlanarPolygon& surface)
      : surface_(surface), T_mesh_world_(surface.frame.T_plane_parent()) {}
  Eigen::Vector3f operator()(GridPoint vertex) const {
    return (T_mesh_world_ * surface_.lift(vertex)).cast<float>();
  }

 private:
  const geometry::PlanarPolygon& surface_;
  Eigen::Isometry3d T_mesh_world_;
};

std::vector<Vertex> corners_of(const geometry::Triangulation& triangulation,
                               const ToMesh& to_mesh) {
  std::vector<Vertex> corners;
  corners.reserve(3 * triangulation.triangles.size());
  for (const auto& triangle : triangulation.triangles) {
    for (const auto vertex : triangle) {
      corners.push_back({.position = to_mesh(triangulation.vertices[vertex])});
    }
  }
  return corners;
}

void add_ring(const Ring& ring, const ToMesh& to_mesh, std::vector<Vertex>& lines) {
  float along = 0.0F;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector3f from = to_mesh(ring[i]);
    const Eigen::Vector3f to = to_mesh(ring[(i + 1) % ring.size()]);
    lines.push_back({.position = from, .along = along});
    along += (to - from).norm();
    lines.push_back({.position = to, .along = along});
  }
}

std::vector<Vertex> outline_of(const geometry::Polygon& polygon, const ToMesh& to_mesh) {
  std::vector<Vertex> lines;
  lines.reserve(2 * geometry::vertex_count(polygon));
  for (const geometry::PolygonPart& part : polygon.parts) {
    add_ring(part.outer, to_mesh, lines);
    for (const Ring& hole : part.holes) add_ring(hole, to_mesh, lines);
  }
  return lines;
}

// The centroid, or the middle of the largest triangle where the centroid lies in a hole.
Eigen::Vector2d middle_of(const geometry::Polygon& polygon,
                          const geometry::Triangulation& triangulation) {
  const Eigen::Vector2d centroid = geometry::area_moments(polygon).centroid;
  if (geometry::contains(polygon, centroid)) return centroid;
  Eigen::Vector2d middle = centroid;
  double largest = 0.0;
  for (const auto& triangle : triangulation.triangles) {
    const Ring ring = {triangulation.vertices[triangle[0]], triangulation.vertices[triangle[1]],
                       triangulation.vertices[triangle[2]]};
    const double area = geometry::signed_area(ring);
    if (area <= largest) continue;
    largest = area;
    middle = (to_metres(ring[0]) + to_metres(ring[1]) + to_metres(ring[2])) / 3.0;
  }
  return middle;
}

bool are_places(const std::vector<Vertex>& vertices) {
  return std::all_of(vertices.begin(), vertices.end(),
                     [](const Vertex& vertex) { return vertex.position.allFinite(); });
}

// Nothing where a number is none: such a surface is nowhere, whatever the message says.
SurfaceShape shape_with(const geometry::PlanarPolygon& surface, std::vector<Vertex> triangles,
                        const Eigen::Vector3d& middle) {
  SurfaceShape shape{.triangles = std::move(triangles),
                     .outline = outline_of(surface.polygon, ToMesh(surface)),
                     .T_world_shape = surface.frame.T_parent_plane(),
                     .normal = surface.plane.normal,
                     .middle = middle};
  const bool is_somewhere = shape.T_world_shape.matrix().allFinite() && middle.allFinite() &&
                            shape.normal.allFinite() && are_places(shape.outline);
  return is_somewhere ? shape : SurfaceShape();
}

}  // namespace

SurfaceShape shape_of(const geometry::PlanarPolygon& surface) {
  if (surface.polygon.empty()) return {};
  const geometry::Triangulation triangulation = geometry::triangulate(surface.polygon);
  return shape_with(surface, corners_of(triangulation, ToMesh(surface)),
                    surface.lift(middle_of(surface.polygon, triangulation)));
}

SurfaceShape outline_shape_of(const geometry::PlanarPolygon& surface) {
  if (surface.polygon.empty()) return {};
  return shape_with(surface, {}, surface.lift(geometry::area_moments(surface.polygon).centroid));
}

}  // namespace geomap::viewer
