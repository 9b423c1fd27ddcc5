// SPDX-License-Identifier: BSD-3-Clause
#include <CGAL/Alpha_shape_2.h>
#include <CGAL/Alpha_shape_face_base_2.h>
#include <CGAL/Alpha_shape_vertex_base_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <iterator>

#include "plane_hulls.hpp"

namespace geomap::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangulation = CGAL::Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<CGAL::Alpha_shape_vertex_base_2<Kernel>,
                                                 CGAL::Alpha_shape_face_base_2<Kernel>>>;
using AlphaShape = CGAL::Alpha_shape_2<Triangulation>;

}  // namespace

std::size_t cgal_alpha_shape(const std::vector<Eigen::Vector2d>& points, double alpha) {
  std::vector<Kernel::Point_2> copies;
  copies.reserve(points.size());
  for (const Eigen::Vector2d& p : points) copies.emplace_back(p.x(), p.y());
  // CGAL's alpha is the square of the radius.
  const AlphaShape shape(copies.begin(), copies.end(), alpha * alpha, AlphaShape::REGULARIZED);
  return static_cast<std::size_t>(
      std::distance(shape.alpha_shape_edges_begin(), shape.alpha_shape_edges_end()));
}

}  // namespace geomap::bench
