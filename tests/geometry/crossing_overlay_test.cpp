// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/crossing_overlay.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/polygon_clip.hpp"
#include "geometry/random_polygons.hpp"
#include "geometry/ring_contacts.hpp"
#include "geometry/snap_overlay.hpp"

namespace geomap::geometry {
namespace {

using testing::box_ring;
using testing::outline_length;
using testing::polygon_of;
using testing::RandomShapes;

std::vector<Ring> rings_in(const Polygon& polygon) {
  std::vector<Ring> rings;
  for (const Ring* ring : rings_of(polygon)) rings.push_back(*ring);
  return rings;
}

double net_area(const std::vector<Ring>& rings) {  // [m²]
  double sum = 0.0;
  for (const Ring& ring : rings) sum += signed_area(ring);
  return sum;
}

// Rings from the smallest vertex on, sorted: equal borders are equal.
std::vector<Ring> sorted(std::vector<Ring> rings) {
  for (Ring& ring : rings) {
    std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()), ring.end());
  }
  std::sort(rings.begin(), rings.end());
  return rings;
}

struct Pair {
  Polygon a, b;
};

Pair jagged_pair(RandomShapes& random) {
  return {random.jagged_polygon(60, 0.2),
          random.jagged_polygon(50, 0.2, {random.between(-1.5, 1.5), random.between(-1.5, 1.5)})};
}

TEST(CrossingOverlay, AgreesWithSnapRoundingOnJaggedPolygonsWithHoles) {
  RandomShapes random(41);
  for (int round = 0; round < 200; ++round) {
    const auto [a, b] = jagged_pair(random);
    const std::vector<Ring> of_a = rings_in(a), of_b = rings_in(b);
    const auto exact = [&](InsideRule inside) { return area(snap_overlay(of_a, of_b, inside)); };
    const double bound = kGridUnit * (outline_length(a) + outline_length(b));
    const auto common = trace_intersection({a}, {b});
    const auto rest = trace_intersection({a}, {b, true});
    const auto neither = trace_intersection({a, true}, {b, true});
    ASSERT_TRUE(common && rest && neither) << round;
    EXPECT_NEAR(net_area(*common), exact([](int p, int q) { return p != 0 && q != 0; }), bound);
    EXPECT_NEAR(net_area(*rest), exact([](int p, int q) { return p != 0 && q == 0; }), bound);
    EXPECT_NEAR(-net_area(*neither), exact([](int p, int q) { return p != 0 || q != 0; }), bound);
  }
}

TEST(CrossingOverlay, NeitherOrderNorPlaceOfTheOperandsMatters) {
  constexpr std::int32_t kKilometre = 10000000;
  RandomShapes random(42);
  for (int round = 0; round < 50; ++round) {
    const auto [a, b] = jagged_pair(random);
    const std::vector<Ring> border = sorted(*trace_intersection({a}, {b, true}));
    EXPECT_EQ(sorted(*trace_intersection({b, true}, {a})), border);
    std::vector<Ring> there =
        *trace_intersection({testing::shifted(a, kKilometre, -kKilometre)},
                            {testing::shifted(b, kKilometre, -kKilometre), true});
    for (Ring& ring : there) {
      for (GridPoint& p : ring) p = {p.x - kKilometre, p.y + kKilometre};
    }
    EXPECT_EQ(sorted(there), border);
  }
}

TEST(CrossingOverlay, BordersThatDoNotMeetAreTakenWhole) {
  const Polygon plate = polygon_of({box_ring(0, 0, 100, 100), box_ring(40, 40, 60, 60)});
  const Polygon island = polygon_of({box_ring(45, 45, 55, 55)});
  EXPECT_TRUE(trace_intersection({plate}, {island})->empty());
  EXPECT_EQ(sorted(*trace_intersection({plate}, {island, true})), sorted(rings_in(plate)));
  const Polygon all = polygon_of({box_ring(-10, -10, 110, 110)});
  EXPECT_EQ(sorted(*trace_intersection({all}, {plate})), sorted(rings_in(plate)));
}

TEST(CrossingOverlay, BarsThatCrossShareASquareAndCutEachOther) {
  const Polygon lying = polygon_of({box_ring(0, 40, 100, 60)});
  const Polygon standing = polygon_of({box_ring(40, 0, 60, 100)});
  EXPECT_EQ(sorted(*trace_intersection({lying}, {standing})), sorted({box_ring(40, 40, 60, 60)}));
  EXPECT_EQ(sorted(*trace_intersection({lying}, {standing, true})),
            sorted({box_ring(0, 40, 40, 60), box_ring(60, 40, 100, 60)}));
}

TEST(CrossingOverlay, GivesNothingWhereBordersTouch) {
  const Polygon square = polygon_of({box_ring(0, 0, 100, 100)});
  const Polygon at_a_corner = polygon_of({box_ring(100, 100, 200, 200)});
  const Polygon along_a_side = polygon_of({box_ring(100, 20, 200, 80)});
  const Polygon corner_on_a_side = polygon_of({{{100, 50}, {150, 0}, {150, 100}}});
  for (const Polygon& other : {at_a_corner, along_a_side, corner_on_a_side, square}) {
    EXPECT_FALSE(trace_intersection({square}, {other}));
    EXPECT_FALSE(trace_intersection({other, true}, {square}));
  }
}

}  // namespace
}  // namespace geomap::geometry
