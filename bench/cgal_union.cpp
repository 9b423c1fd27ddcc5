// SPDX-License-Identifier: BSD-3-Clause
#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_set_2.h>

#include "polygon_unions.hpp"

namespace geomap::bench {
namespace {

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Set = CGAL::Polygon_set_2<ExactKernel>;

CGAL::Polygon_2<ExactKernel> converted(const geometry::Ring& ring) {
  CGAL::Polygon_2<ExactKernel> result;
  for (const geometry::GridPoint p : ring) result.push_back(ExactKernel::Point_2(p.x, p.y));
  return result;
}

Set converted(const geometry::Polygon& polygon) {
  Set result;
  for (const geometry::PolygonPart& part : polygon.parts) {
    Set whole(converted(part.outer));
    for (const geometry::Ring& hole : part.holes) {
      CGAL::Polygon_2<ExactKernel> filled = converted(hole);
      filled.reverse_orientation();
      whole.difference(filled);
    }
    result.join(whole);
  }
  return result;
}

}  // namespace

Union cgal_union(const geometry::Polygon& a, const geometry::Polygon& b) {
  return [a = converted(a), b = converted(b)] {
    Set both = a;
    both.join(b);
    return static_cast<std::size_t>(both.number_of_polygons_with_holes());
  };
}

}  // namespace geomap::bench
