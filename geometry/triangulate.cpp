// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/triangulate.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <map>

#include "geometry/polygon_clip.hpp"
#include "geometry/ring_contacts.hpp"

namespace geomap::geometry {
namespace {

constexpr int kUnknown = -1;  // how many outlines separate a face from the outside

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceInfoBase = CGAL::Triangulation_face_base_with_info_2<int, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel, FaceInfoBase>;
using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>, CGAL::Exact_predicates_tag>;

// Inserts a ring's vertices and edges; a vertex that rings share is one vertex.
void insert_ring(const Ring& ring, std::map<GridPoint, Delaunay::Vertex_handle>& handles,
                 Delaunay& delaunay, std::vector<GridPoint>& vertices) {
  Delaunay::Face_handle near;
  for (const GridPoint p : ring) {
    const auto [entry, is_new] = handles.try_emplace(p);
    if (is_new) {
      entry->second = delaunay.insert(Kernel::Point_2(p.x, p.y), near);
      entry->second->info() = static_cast<std::uint32_t>(vertices.size());
      vertices.push_back(p);
    }
    near = entry->second->face();
  }
  for (std::size_t i = 0; i < ring.size(); ++i) {
    delaunay.insert_constraint(handles.at(ring[i]),
                               handles.at(ring[i + 1 == ring.size() ? 0 : i + 1]));
  }
}

// Marks every face with the number of outlines between it and the outside: odd ones are inside.
void mark_faces(Delaunay& delaunay) {
  for (const Delaunay::Face_handle face : delaunay.all_face_handles()) face->info() = kUnknown;
  std::vector<Delaunay::Face_handle> level{delaunay.infinite_face()};
  for (int depth = 0; !level.empty(); ++depth) {
    std::vector<Delaunay::Face_handle> beyond;  // of an outline
    while (!level.empty()) {
      const Delaunay::Face_handle face = level.back();
      level.pop_back();
      if (face->info() != kUnknown) continue;
      face->info() = depth;
      for (int i = 0; i < 3; ++i) {
        const Delaunay::Face_handle neighbour = face->neighbor(i);
        if (neighbour->info() != kUnknown) continue;
        (face->is_constrained(i) ? beyond : level).push_back(neighbour);
      }
    }
    level = std::move(beyond);
  }
}

// Counter-clockwise, as CGAL's faces are, from the smallest index on.
std::array<std::uint32_t, 3> corners(Delaunay::Face_handle face) {
  std::array<std::uint32_t, 3> result{face->vertex(0)->info(), face->vertex(1)->info(),
                                      face->vertex(2)->info()};
  std::rotate(result.begin(), std::min_element(result.begin(), result.end()), result.end());
  return result;
}

}  // namespace

Triangulation triangulate(const Polygon& polygon) {
  if (!find_fault(polygon).empty()) {
    std::vector<Ring> rings;
    for (const Ring* ring : rings_of(polygon)) rings.push_back(*ring);
    return triangulate(from_rings(rings, FillRule::kEvenOdd));
  }
  Triangulation result;
  Delaunay delaunay;
  std::map<GridPoint, Delaunay::Vertex_handle> handles;
  for (const Ring* ring : rings_of(polygon)) {
    insert_ring(*ring, handles, delaunay, result.vertices);
  }
  if (delaunay.dimension() != 2) return result;
  mark_faces(delaunay);
  for (const Delaunay::Face_handle face : delaunay.finite_face_handles()) {
    if (face->info() % 2 != 0) result.triangles.push_back(corners(face));
  }
  std::sort(result.triangles.begin(), result.triangles.end());
  return result;
}

}  // namespace geomap::geometry
