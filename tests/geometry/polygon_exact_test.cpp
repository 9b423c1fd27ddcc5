// SPDX-License-Identifier: BSD-3-Clause
// Clipping against CGAL's exact arithmetic. The only test that includes CGAL.
#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_set_2.h>
#include <gtest/gtest.h>

#include <list>

#include "geometry/polygon_clip.hpp"
#include "geometry/random_polygons.hpp"

namespace geomap::geometry {
namespace {

using testing::outline_length;
using testing::RandomShapes;

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactRing = CGAL::Polygon_2<Kernel>;
using ExactPart = CGAL::Polygon_with_holes_2<Kernel>;
using ExactSet = CGAL::Polygon_set_2<Kernel>;

ExactRing exact(const Ring& ring) {
  ExactRing result;
  for (const GridPoint p : ring) result.push_back(Kernel::Point_2(p.x, p.y));
  return result;
}

ExactSet exact(const Polygon& polygon) {
  ExactSet result;
  for (const PolygonPart& part : polygon.parts) {
    ExactSet whole(exact(part.outer));
    for (const Ring& hole : part.holes) {
      ExactRing filled = exact(hole);
      filled.reverse_orientation();
      whole.difference(filled);
    }
    result.join(whole);
  }
  return result;
}

double exact_area(const ExactSet& set) {  // [m²]
  std::list<ExactPart> parts;
  set.polygons_with_holes(std::back_inserter(parts));
  Kernel::FT sum = 0;
  for (const ExactPart& part : parts) {
    sum += part.outer_boundary().area();
    for (const ExactRing& hole : part.holes()) sum += hole.area();  // clockwise: negative
  }
  return CGAL::to_double(sum) * kGridUnit * kGridUnit;
}

void expect_exact_areas(const Polygon& a, const Polygon& b) {
  // A vertex moves by at most a grid unit; up to five slivers of 1 mm² are left out.
  const double bound = kGridUnit * (outline_length(a) + outline_length(b)) + 5e-6;
  ExactSet united = exact(a), common = exact(a), rest = exact(a);
  const ExactSet other = exact(b);
  united.join(other);
  common.intersection(other);
  rest.difference(other);
  EXPECT_NEAR(area(a), exact_area(exact(a)), 1e-9);
  EXPECT_NEAR(area(unite(a, b)), exact_area(united), bound);
  EXPECT_NEAR(area(intersect(a, b)), exact_area(common), bound);
  EXPECT_NEAR(area(subtract(a, b)), exact_area(rest), bound);
}

TEST(ExactOracle, AgreesOnJaggedPolygonsWithHoles) {
  RandomShapes random(1);
  for (int round = 0; round < 10; ++round) {
    const Polygon a = random.jagged_polygon(30, 0.2);
    expect_exact_areas(
        a, random.jagged_polygon(24, 0.2, {random.between(-1.0, 1.0), random.between(-1.0, 1.0)}));
  }
}

TEST(ExactOracle, AgreesOnACoarseGridWhereEverythingCoincides) {
  RandomShapes random(2);
  for (int round = 0; round < 150; ++round) {
    const Polygon a = random.coarse_polygon(1000);
    expect_exact_areas(a, random.coarse_polygon(1000));
  }
}

TEST(ExactOracle, EvenOddReadingOfATangleIsTheExactOne) {
  RandomShapes random(3);
  for (int round = 0; round < 100; ++round) {
    // The triangle fan of a closed walk about the origin, joined by exclusive or, is its even-odd
    // area.
    const Ring walk = random.coarse_ring(7, 1000);
    ExactSet expected;
    for (std::size_t i = 1; i + 1 < walk.size(); ++i) {
      ExactRing triangle = exact({walk[0], walk[i], walk[i + 1]});
      if (triangle.area() == 0) continue;
      if (triangle.is_clockwise_oriented()) triangle.reverse_orientation();
      expected.symmetric_difference(triangle);
    }
    const Polygon polygon = from_rings(std::vector<Ring>{walk}, FillRule::kEvenOdd);
    EXPECT_NEAR(area(polygon), exact_area(expected), 5e-4) << round;
  }
}

}  // namespace
}  // namespace geomap::geometry
