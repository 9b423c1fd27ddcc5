// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/crossing_overlay.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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

bool in_both(int a, int b) { return a != 0 && b != 0; }
bool in_either(int a, int b) { return a != 0 || b != 0; }
bool in_first(int a, int b) { return a != 0 && b == 0; }
bool in_second(int a, int b) { return a == 0 && b != 0; }
bool in_odd(int a, int) { return a % 2 != 0; }
bool in_positive(int a, int) { return a > 0; }

std::vector<Ring> sorted_rings(const std::optional<TracedBorder>& border) {
  return sorted(border.value().rings);
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
  for (int round = 0; round < 100; ++round) {
    const auto [a, b] = jagged_pair(random);
    const double bound = kGridUnit * (outline_length(a) + outline_length(b));
    for (const InsideRule inside : {in_both, in_either, in_first, in_second}) {
      const auto border = trace_overlay(a, b, inside);
      ASSERT_TRUE(border) << round;
      EXPECT_NEAR(net_area(border->rings), area(snap_overlay(rings_in(a), rings_in(b), inside)),
                  bound);
    }
  }
}

TEST(CrossingOverlay, AgreesWithSnapRoundingOnRingsThatCrossThemselves) {
  RandomShapes random(43);
  int traced = 0;
  for (int round = 0; round < 100; ++round) {
    std::vector<Ring> tangle(2);
    for (Ring& ring : tangle) {
      for (int i = 0; i < 9; ++i) {
        const std::int32_t x = random.below(20000);
        ring.push_back({x, random.below(20000)});
      }
    }
    const auto border = trace_overlay(tangle, in_positive);
    ASSERT_TRUE(border) << round;
    EXPECT_NEAR(net_area(border->rings), area(snap_overlay(tangle, {}, in_positive)), 0.01);
    // An even-odd border passes twice through every crossing: which way to turn is not told.
    traced += trace_overlay(tangle, in_odd).has_value() ? 1 : 0;
  }
  EXPECT_EQ(traced, 0);
}

TEST(CrossingOverlay, NeitherOrderNorPlaceOfTheOperandsMatters) {
  constexpr std::int32_t kKilometre = 10000000;
  RandomShapes random(42);
  for (int round = 0; round < 50; ++round) {
    const auto [a, b] = jagged_pair(random);
    const std::vector<Ring> border = sorted_rings(trace_overlay(a, b, in_first));
    EXPECT_EQ(sorted_rings(trace_overlay(b, a, in_second)), border);
    std::vector<Ring> there = trace_overlay(testing::shifted(a, kKilometre, -kKilometre),
                                            testing::shifted(b, kKilometre, -kKilometre), in_first)
                                  ->rings;
    for (Ring& ring : there) {
      for (GridPoint& p : ring) p = {p.x - kKilometre, p.y + kKilometre};
    }
    EXPECT_EQ(sorted(there), border);
  }
}

TEST(CrossingOverlay, BordersThatDoNotMeetAreTakenWhole) {
  const Polygon plate = polygon_of({box_ring(0, 0, 100, 100), box_ring(40, 40, 60, 60)});
  const Polygon island = polygon_of({box_ring(45, 45, 55, 55)});
  EXPECT_TRUE(trace_overlay(plate, island, in_both)->rings.empty());
  EXPECT_EQ(sorted_rings(trace_overlay(plate, island, in_first)), sorted(rings_in(plate)));
  const Polygon all = polygon_of({box_ring(-10, -10, 110, 110)});
  EXPECT_EQ(sorted_rings(trace_overlay(all, plate, in_both)), sorted(rings_in(plate)));
  const std::vector<Ring> plate_and_island{box_ring(0, 0, 100, 100), box_ring(40, 40, 60, 60),
                                           box_ring(45, 45, 55, 55)};
  EXPECT_EQ(trace_overlay(plate_and_island, in_odd)->rings.size(), 3U);
  EXPECT_EQ(trace_overlay(plate_and_island, in_positive)->rings.size(), 1U);
}

TEST(CrossingOverlay, BarsThatCrossShareASquareAndCutEachOther) {
  const Polygon lying = polygon_of({box_ring(0, 40, 100, 60)});
  const Polygon standing = polygon_of({box_ring(40, 0, 60, 100)});
  EXPECT_EQ(sorted_rings(trace_overlay(lying, standing, in_both)),
            sorted({box_ring(40, 40, 60, 60)}));
  EXPECT_EQ(sorted_rings(trace_overlay(lying, standing, in_first)),
            sorted({box_ring(0, 40, 40, 60), box_ring(60, 40, 100, 60)}));
}

TEST(CrossingOverlay, GivesNothingWhereBordersTouch) {
  const Polygon square = polygon_of({box_ring(0, 0, 100, 100)});
  const Polygon at_a_corner = polygon_of({box_ring(100, 100, 200, 200)});
  const Polygon along_a_side = polygon_of({box_ring(100, 20, 200, 80)});
  const Polygon corner_on_a_side = polygon_of({{{100, 50}, {150, 0}, {150, 100}}});
  for (const Polygon& other : {at_a_corner, along_a_side, corner_on_a_side, square}) {
    EXPECT_FALSE(trace_overlay(square, other, in_both));
    EXPECT_FALSE(trace_overlay(other, square, in_either));
  }
  const Ring spike{{0, 0}, {50, 0}, {50, 90}, {50, 0}, {100, 0}, {100, 100}, {0, 100}};
  EXPECT_FALSE(trace_overlay(std::array{spike}, in_odd));
  const Ring twice_the_same{{0, 0}, {0, 0}, {50, 0}, {50, 90}};
  EXPECT_FALSE(trace_overlay(std::array{twice_the_same}, in_odd));
}

}  // namespace
}  // namespace geomap::geometry
