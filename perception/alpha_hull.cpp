// SPDX-License-Identifier: BSD-3-Clause
#include "perception/alpha_hull.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace geomap::perception {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

struct FaceMark {
  bool is_inside = false;
  std::array<bool, 3> is_walked{};  // border edge opposite to vertex i is in a ring already
};

using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<FaceMark, Kernel>;
using Delaunay =
    CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;
using Face = Delaunay::Face_handle;

// Disjoint sets whose representative is the smallest member.
class Groups {
 public:
  explicit Groups(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

void require_valid(std::span<const Eigen::Vector2d> points, std::span<const double> radius,
                   double link) {
  if (points.size() != radius.size()) {
    throw std::invalid_argument("alpha_hull: as many radii as points are needed");
  }
  const bool is_valid =
      std::isfinite(link) && link >= 0.0 &&
      std::all_of(points.begin(), points.end(), [](const auto& p) { return p.allFinite(); }) &&
      std::all_of(radius.begin(), radius.end(),
                  [](double r) { return std::isfinite(r) && r > 0.0; });
  if (!is_valid) throw std::invalid_argument("alpha_hull: points and radii must be finite, radii > 0");
}

double circumradius_squared(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                            const Eigen::Vector2d& c) {
  const Eigen::Vector2d ab = b - a, ac = c - a, bc = c - b;
  const double twice_area = ab.x() * ac.y() - ab.y() * ac.x();
  return ab.squaredNorm() * ac.squaredNorm() * bc.squaredNorm() / (4.0 * twice_area * twice_area);
}

void mark_inside(const Delaunay& delaunay, std::span<const Eigen::Vector2d> points,
                 std::span<const double> radius) {
  for (const Face face : delaunay.finite_face_handles()) {
    const std::uint32_t a = face->vertex(0)->info(), b = face->vertex(1)->info(),
                        c = face->vertex(2)->info();
    const double limit = std::max({radius[a], radius[b], radius[c]});
    // Infinite or not a number for a flat triangle: outside.
    face->info().is_inside =
        circumradius_squared(points[a], points[b], points[c]) <= limit * limit;
  }
}

void link_neighbours(const Delaunay& delaunay, std::span<const Eigen::Vector2d> points,
                     std::span<const double> radius, double link, Groups& groups) {
  for (const auto& [face, i] : delaunay.finite_edges()) {
    const std::uint32_t a = face->vertex(Delaunay::cw(i))->info();
    const std::uint32_t b = face->vertex(Delaunay::ccw(i))->info();
    const double reach = link * std::max(radius[a], radius[b]);
    const bool is_side = delaunay.dimension() == 2 && (face->info().is_inside ||
                                                       face->neighbor(i)->info().is_inside);
    if (is_side || (points[a] - points[b]).squaredNorm() <= reach * reach) groups.join(a, b);
  }
}

bool is_border(const Face& face, int i) {
  return face->info().is_inside && !face->neighbor(i)->info().is_inside;
}

// Follows the border with the area on the left, turning about each vertex through the area's triangles.
std::vector<std::uint32_t> walk_ring(Face face, int i) {
  std::vector<std::uint32_t> ring;
  while (!face->info().is_walked[static_cast<std::size_t>(i)]) {
    face->info().is_walked[static_cast<std::size_t>(i)] = true;
    ring.push_back(face->vertex(Delaunay::ccw(i))->info());
    const auto pivot = face->vertex(Delaunay::cw(i));
    // The next edge of this triangle starts at the pivot; cross it while there is area beyond.
    i = Delaunay::ccw(i);
    while (!is_border(face, i)) {
      face = face->neighbor(i);
      i = Delaunay::cw(face->index(pivot));
    }
  }
  return ring;
}

// Triangulates the points; coinciding ones are joined.
Delaunay triangulate(std::span<const Eigen::Vector2d> points, Groups& groups) {
  using Indexed = std::pair<Kernel::Point_2, std::uint32_t>;
  std::vector<Indexed> order;
  order.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    order.emplace_back(Kernel::Point_2(points[i].x(), points[i].y()), static_cast<std::uint32_t>(i));
  }
  using Sorting =
      CGAL::Spatial_sort_traits_adapter_2<Kernel, CGAL::First_of_pair_property_map<Indexed>>;
  CGAL::spatial_sort(order.begin(), order.end(), Sorting());

  Delaunay delaunay;
  Face near;
  for (const auto& [point, index] : order) {
    const std::size_t before = delaunay.number_of_vertices();
    const Delaunay::Vertex_handle vertex = delaunay.insert(point, near);
    if (delaunay.number_of_vertices() > before) {
      vertex->info() = index;
    } else {
      groups.join(vertex->info(), index);
    }
    near = vertex->face();
  }
  return delaunay;
}

void number_groups(Groups& groups, AlphaHull& hull) {
  for (std::size_t i = 0; i < hull.group.size(); ++i) {
    const std::uint32_t first = groups.find(static_cast<std::uint32_t>(i));
    hull.group[i] = first == i ? hull.groups++ : hull.group[first];
  }
}

void walk_rings(const Delaunay& delaunay, AlphaHull& hull) {
  for (const Face face : delaunay.finite_face_handles()) {
    for (int i = 0; i < 3; ++i) {
      if (!is_border(face, i) || face->info().is_walked[static_cast<std::size_t>(i)]) continue;
      hull.rings.push_back(walk_ring(face, i));
      hull.ring_group.push_back(hull.group[hull.rings.back().front()]);
    }
  }
}

}  // namespace

AlphaHull alpha_hull(std::span<const Eigen::Vector2d> points, std::span<const double> radius,
                     double link) {
  require_valid(points, radius, link);
  Groups groups(points.size());
  const Delaunay delaunay = triangulate(points, groups);
  if (delaunay.dimension() == 2) mark_inside(delaunay, points, radius);
  if (delaunay.dimension() >= 1) link_neighbours(delaunay, points, radius, link, groups);

  AlphaHull hull;
  hull.group.resize(points.size());
  number_groups(groups, hull);
  if (delaunay.dimension() == 2) walk_rings(delaunay, hull);
  return hull;
}

}  // namespace geomap::perception
