// SPDX-License-Identifier: BSD-3-Clause
#include "perception/alpha_hull.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>
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
    CGAL::Delaunay_triangulation_2<Kernel,
                                   CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;
using Face = Delaunay::Face_handle;

void require_valid(std::span<const Eigen::Vector2d> points, std::span<const double> radius) {
  if (points.size() != radius.size()) {
    throw std::invalid_argument("alpha_hull: as many radii as points are needed");
  }
  const bool is_valid =
      std::all_of(points.begin(), points.end(), [](const auto& p) { return p.allFinite(); }) &&
      std::all_of(radius.begin(), radius.end(),
                  [](double r) { return std::isfinite(r) && r > 0.0; });
  if (!is_valid)
    throw std::invalid_argument("alpha_hull: points and radii must be finite, radii > 0");
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
    face->info().is_inside = circumradius_squared(points[a], points[b], points[c]) <= limit * limit;
  }
}

bool is_border(const Face& face, int i) {
  return face->info().is_inside && !face->neighbor(i)->info().is_inside;
}

// Follows the border with the area on the left, turning about each vertex through the area's
// triangles.
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

Delaunay triangulate(std::span<const Eigen::Vector2d> points) {
  std::vector<std::pair<Kernel::Point_2, std::uint32_t>> indexed;
  indexed.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    indexed.emplace_back(Kernel::Point_2(points[i].x(), points[i].y()),
                         static_cast<std::uint32_t>(i));
  }
  Delaunay delaunay;
  delaunay.insert(indexed.begin(), indexed.end());
  return delaunay;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> alpha_hull(std::span<const Eigen::Vector2d> points,
                                                   std::span<const double> radius) {
  require_valid(points, radius);
  std::vector<std::vector<std::uint32_t>> rings;
  const Delaunay delaunay = triangulate(points);
  if (delaunay.dimension() < 2) return rings;
  mark_inside(delaunay, points, radius);
  for (const Face face : delaunay.finite_face_handles()) {
    for (int i = 0; i < 3; ++i) {
      if (is_border(face, i) && !face->info().is_walked[static_cast<std::size_t>(i)]) {
        rings.push_back(walk_ring(face, i));
      }
    }
  }
  return rings;
}

}  // namespace geomap::perception
