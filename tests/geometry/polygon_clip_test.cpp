// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/polygon_clip.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

#include "geometry/offset_rings.hpp"
#include "geometry/random_polygons.hpp"

namespace geomap::geometry {
namespace {

using testing::box_ring;
using testing::distance_to_outline;
using testing::outline_length;
using testing::polygon_of;
using testing::RandomShapes;

constexpr double kSquareMillimetre = 1e-6;  // [m²]

// What rounding to the grid and dropping slivers may change: one grid unit along the outlines, and
// 1 mm² for each of a handful of slivers.
double tolerance(const Polygon& a, const Polygon& b) {
  return kGridUnit * (outline_length(a) + outline_length(b)) + 10 * kSquareMillimetre;
}

void expect_valid(const Polygon& polygon, const char* what) {
  EXPECT_EQ(find_fault(polygon), "") << what;
  EXPECT_EQ(canonical(polygon), polygon) << what;
}

void expect_set_algebra(const Polygon& a, const Polygon& b) {
  const Polygon united = unite(a, b), common = intersect(a, b);
  const Polygon only_a = subtract(a, b), only_b = subtract(b, a);
  const double bound = tolerance(a, b);
  EXPECT_GE(area(united), std::max(area(a), area(b)) - bound);
  EXPECT_LE(area(united), area(a) + area(b) + bound);
  EXPECT_NEAR(area(united) + area(common), area(a) + area(b), bound);
  EXPECT_NEAR(area(only_a) + area(common), area(a), bound);
  EXPECT_NEAR(area(unite(only_a, only_b)) + area(common), area(united), bound);
  EXPECT_NEAR(area(intersect(united, a)), area(a), bound) << "absorption";
  EXPECT_EQ(united, unite(b, a));
  EXPECT_EQ(common, intersect(b, a));
  EXPECT_EQ(unite(united, united), united);
}

TEST(Clip, KeepsTheLawsOfSetsOnJaggedOutlines) {
  RandomShapes random(1);
  for (int round = 0; round < 60; ++round) {
    const Polygon a = random.jagged_polygon(60, 0.1);
    const Polygon b =
        random.jagged_polygon(50, 0.1, {random.between(-1.5, 1.5), random.between(-1.5, 1.5)});
    expect_set_algebra(a, b);
  }
}

class CoarseGrid : public ::testing::TestWithParam<std::int32_t> {};

// Coarse grids make vertices lie on edges and edges on each other everywhere: where clippers fail.
TEST_P(CoarseGrid, EveryResultHoldsTheInvariant) {
  RandomShapes random(2);
  for (int round = 0; round < 500; ++round) {
    const Polygon a = random.coarse_polygon(GetParam()), b = random.coarse_polygon(GetParam());
    const Polygon only_a = subtract(a, b), only_b = subtract(b, a);
    const Polygon either = unite(only_a, only_b);
    const Polygon chain = unite(subtract(unite(a, b), either), intersect(either, a));
    const double distance = 0.4 * GetParam() * kGridUnit;
    expect_valid(a, "from rings");
    expect_valid(unite(a, b), "union");
    expect_valid(intersect(a, b), "intersection");
    expect_valid(only_a, "difference");
    expect_valid(either, "exclusive or");
    expect_valid(chain, "chain");
    expect_valid(offset(either, distance), "grown");
    expect_valid(offset(either, -distance), "shrunk");
    expect_valid(from_rings(std::array{random.coarse_ring(9, GetParam())}, FillRule::kNonZero),
                 "non-zero");
    if (HasFailure()) break;
  }
}

TEST_P(CoarseGrid, KeepsTheLawsOfSets) {
  RandomShapes random(4);
  for (int round = 0; round < 300 && !HasFailure(); ++round) {
    const Polygon a = random.coarse_polygon(GetParam());
    expect_set_algebra(a, random.coarse_polygon(GetParam()));
  }
}

INSTANTIATE_TEST_SUITE_P(Steps, CoarseGrid, ::testing::Values(1, 7, 100, 5000));

TEST(Clip, DoesNotDependOnWhereTheOriginIs) {
  RandomShapes random(8);
  constexpr std::int32_t kKilometre = 10000000;
  for (int round = 0; round < 30; ++round) {
    const Polygon a = random.jagged_polygon(50, 0.2),
                  b = random.jagged_polygon(40, 0.2, {0.5, 0.3});
    const Polygon there = unite(testing::shifted(a, kKilometre, -kKilometre),
                                testing::shifted(b, kKilometre, -kKilometre));
    EXPECT_EQ(testing::shifted(there, -kKilometre, kKilometre), unite(a, b));
  }
}

TEST(Clip, WorksAtTheCornersOfTheGrid) {
  constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
  constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min();
  const Polygon low = polygon_of({box_ring(kLeast, kLeast, kLeast + 10000, kLeast + 10000)});
  const Polygon high = polygon_of({box_ring(kMost - 10000, kMost - 10000, kMost, kMost)});
  const Polygon all = polygon_of({box_ring(kLeast, kLeast, kMost, kMost)});
  EXPECT_DOUBLE_EQ(area(unite(low, high)), 2.0);
  EXPECT_EQ(unite(all, high), all);
  EXPECT_EQ(intersect(all, low), low);
  const Polygon rest = subtract(subtract(all, low), high);
  expect_valid(rest, "all but two corners");
  EXPECT_DOUBLE_EQ(area(rest), area(all) - 2.0);
}

TEST(Unite, OfManyIsTheUnionOneByOne) {
  RandomShapes random(9);
  std::vector<Polygon> polygons;
  Polygon sum;
  double length = 0.0;
  for (int i = 0; i < 12; ++i) {
    polygons.push_back(
        random.jagged_polygon(30, 0.2, {random.between(-2.0, 2.0), random.between(-2.0, 2.0)}));
    sum = unite(sum, polygons.back());
    length += outline_length(polygons.back());
  }
  const Polygon at_once = unite(polygons);
  expect_valid(at_once, "union of many");
  EXPECT_NEAR(area(at_once), area(sum), kGridUnit * length);
  std::reverse(polygons.begin(), polygons.end());
  EXPECT_EQ(unite(polygons), at_once) << "in any order";
}

TEST(Unite, JoinsSquaresThatShareAnEdgeWithoutLeavingVertices) {
  const Polygon joined = unite(polygon_of({box_ring(0, 0, 10000, 10000)}),
                               polygon_of({box_ring(10000, 0, 20000, 10000)}));
  EXPECT_EQ(joined, polygon_of({box_ring(0, 0, 20000, 10000)}));
  EXPECT_EQ(vertex_count(joined), 4U);
}

TEST(Unite, KeepsSquaresApartThatTouchInACorner) {
  const Polygon both = unite(polygon_of({box_ring(0, 0, 10000, 10000)}),
                             polygon_of({box_ring(10000, 10000, 20000, 20000)}));
  expect_valid(both, "corner to corner");
  EXPECT_EQ(both.parts.size(), 2U);
}

TEST(Unite, FillsAHoleAndKeepsAnIslandInIt) {
  const Polygon frame =
      polygon_of({box_ring(0, 0, 30000, 30000), box_ring(5000, 5000, 25000, 25000)});
  const Polygon island = polygon_of({box_ring(10000, 10000, 12000, 12000)});
  const Polygon both = unite(frame, island);
  EXPECT_EQ(both.parts.size(), 2U);
  EXPECT_NEAR(area(both), 9.0 - 4.0 + 0.04, 1e-9);
  EXPECT_EQ(unite(both, polygon_of({box_ring(5000, 5000, 25000, 25000)})),
            polygon_of({box_ring(0, 0, 30000, 30000)}));
}

TEST(Clip, EmptyOperandsAreNeutral) {
  const Polygon box = polygon_of({box_ring(0, 0, 100, 100)});
  EXPECT_EQ(unite(box, {}), box);
  EXPECT_EQ(unite({}, box), box);
  EXPECT_EQ(unite(std::span<const Polygon>{}), Polygon{});
  EXPECT_TRUE(intersect(box, {}).empty());
  EXPECT_EQ(subtract(box, {}), box);
  EXPECT_TRUE(subtract({}, box).empty());
  EXPECT_TRUE(subtract(box, box).empty());
  EXPECT_TRUE(offset({}, 1.0).empty());
}

TEST(FromRings, FlatPointLikeAndEmptyRingsLeaveNothing) {
  const auto both_rules_leave_nothing = [](const std::vector<Ring>& rings) {
    return from_rings(rings, FillRule::kEvenOdd).empty() &&
           from_rings(rings, FillRule::kNonZero).empty();
  };
  EXPECT_TRUE(both_rules_leave_nothing({}));
  EXPECT_TRUE(both_rules_leave_nothing({Ring{}}));
  EXPECT_TRUE(both_rules_leave_nothing({Ring(10, {500, 500})})) << "ten equal points";
  EXPECT_TRUE(both_rules_leave_nothing({{{0, 0}, {1000, 1000}, {3000, 3000}, {500, 500}}}));
  EXPECT_TRUE(both_rules_leave_nothing({{{0, 0}, {1000, 0}}}));
  EXPECT_TRUE(both_rules_leave_nothing({box_ring(0, 0, 9, 11)})) << "below 1 mm²";
}

TEST(FromRings, AHoleBelowASquareMillimetreIsFilled) {
  const Ring plate = box_ring(0, 0, 1000, 1000);
  EXPECT_EQ(polygon_of({plate, box_ring(500, 500, 509, 511)}), polygon_of({plate}));
  EXPECT_EQ(polygon_of({plate, box_ring(500, 500, 510, 510)}).parts[0].holes.size(), 1U);
}

TEST(FromRings, ABowTieBecomesTwoTriangles) {
  const Polygon tie = polygon_of({{{0, 0}, {1000, 1000}, {1000, 0}, {0, 1000}}});
  expect_valid(tie, "bow tie");
  EXPECT_EQ(tie.parts.size(), 2U);
  EXPECT_NEAR(area(tie), 0.005, 1e-9);
}

TEST(FromRings, AFigureEightBecomesTwoRingsThatTouch) {
  const Ring eight{{0, 0}, {5000, 5000}, {10000, 0}, {10000, 10000}, {5000, 5000}, {0, 10000}};
  const Polygon polygon = polygon_of({eight});
  expect_valid(polygon, "figure eight");
  EXPECT_EQ(polygon.parts.size(), 2U);
  EXPECT_NEAR(area(polygon), 0.5, 1e-9);
}

TEST(FromRings, RepeatedAndCollinearVerticesAreRemoved) {
  const Ring noisy{{0, 0},       {0, 0},      {500, 0},  {1000, 0}, {1000, 0},
                   {1000, 1000}, {400, 1000}, {0, 1000}, {0, 0}};
  EXPECT_EQ(polygon_of({noisy}), polygon_of({box_ring(0, 0, 1000, 1000)}));
}

TEST(FromRings, ASpikeIsRemoved) {
  EXPECT_EQ(
      polygon_of(
          {{{0, 0}, {1000, 0}, {1000, 500}, {4000, 500}, {1000, 500}, {1000, 1000}, {0, 1000}}}),
      polygon_of({box_ring(0, 0, 1000, 1000)}));
}

TEST(FromRings, AHoleTouchingTheOutlineStaysAHole) {
  const Polygon polygon =
      polygon_of({box_ring(0, 0, 10000, 10000), {{0, 5000}, {4000, 6000}, {4000, 4000}}});
  expect_valid(polygon, "hole touching the outline");
  ASSERT_EQ(polygon.parts.size(), 1U);
  EXPECT_EQ(polygon.parts[0].holes.size(), 1U);
  EXPECT_NEAR(area(polygon), 1.0 - 0.04, 1e-9);
}

TEST(FromRings, AHoleSharingPartOfAnEdgeBecomesADent) {
  const Polygon polygon =
      polygon_of({box_ring(0, 0, 40000, 40000), box_ring(0, 10000, 10000, 20000)});
  expect_valid(polygon, "hole on the edge");
  ASSERT_EQ(polygon.parts.size(), 1U);
  EXPECT_TRUE(polygon.parts[0].holes.empty());
  EXPECT_EQ(polygon.parts[0].outer.size(), 8U);
  EXPECT_DOUBLE_EQ(area(polygon), 15.0);
}

TEST(FromRings, EvenOddDoesNotAskForOrientations) {
  const Ring outer = box_ring(0, 0, 10000, 10000), hole = box_ring(2000, 2000, 4000, 4000);
  const auto reversed = [](Ring ring) {
    std::reverse(ring.begin(), ring.end());
    return ring;
  };
  const Polygon expected = polygon_of({outer, hole});
  EXPECT_NEAR(area(expected), 0.96, 1e-12);
  EXPECT_EQ(polygon_of({reversed(outer), hole}), expected);
  EXPECT_EQ(polygon_of({hole, reversed(outer)}), expected);
  EXPECT_EQ(polygon_of({reversed(hole), reversed(outer)}), expected);
  EXPECT_EQ(from_rings(std::array{outer, reversed(hole)}, FillRule::kNonZero), expected);
  EXPECT_NEAR(area(from_rings(std::array{outer, hole}, FillRule::kNonZero)), 1.0, 1e-12);
}

TEST(Offset, GrowingAndShrinkingARectangleGivesItBack) {
  const Polygon box = polygon_of({box_ring(-5000, 0, 15000, 7000)});
  const Polygon grown = offset(box, 0.015);
  EXPECT_EQ(grown, polygon_of({box_ring(-5150, -150, 15150, 7150)}));
  EXPECT_EQ(offset(grown, -0.015), box);
  EXPECT_EQ(offset(box, 0.0), box);
}

TEST(Offset, GrowingShrinksHolesAndShrinkingOpensThem) {
  const Polygon frame =
      polygon_of({box_ring(0, 0, 20000, 20000), box_ring(8000, 8000, 12000, 12000)});
  EXPECT_NEAR(area(offset(frame, 0.1)), 2.2 * 2.2 - 0.2 * 0.2, 1e-9);
  EXPECT_NEAR(area(offset(frame, -0.1)), 1.8 * 1.8 - 0.6 * 0.6, 1e-9);
  EXPECT_NEAR(area(offset(frame, 0.3)), 2.6 * 2.6, 1e-9) << "the hole has closed";
  EXPECT_TRUE(offset(frame, -0.5).empty()) << "nothing is left";
}

TEST(Offset, ClosesAGapBetweenTwoParts) {
  const Polygon halves =
      polygon_of({box_ring(0, 0, 9900, 10000), box_ring(10100, 0, 20000, 10000)});
  EXPECT_EQ(halves.parts.size(), 2U);
  EXPECT_EQ(offset(offset(halves, 0.015), -0.015), polygon_of({box_ring(0, 0, 20000, 10000)}));
}

TEST(Offset, SharpCornersDoNotFlyOff) {
  const Polygon needle = polygon_of({{{0, 0}, {50000, 100}, {0, 200}}});  // a 5 m needle, 2 cm wide
  const Polygon grown = offset(needle, 0.05);
  expect_valid(grown, "grown needle");
  EXPECT_LT(bounding_box(grown).max().x(), 5.0 + 2.5 * 0.05);
}

TEST(Offset, MovesTheOutlineByTheDistanceAndAtCornersByNoMoreThanTheMitreLimit) {
  RandomShapes random(12);
  constexpr double kRounding = 3 * kGridUnit;
  int kept = 0, lost = 0;
  for (int round = 0; round < 40; ++round) {
    const Polygon polygon = random.jagged_polygon(80, 0.4);  // edges of centimetres
    const double distance = random.between(0.005, 0.08);
    const Polygon grown = offset(polygon, distance), shrunk = offset(polygon, -distance);
    expect_valid(grown, "grown");
    expect_valid(shrunk, "shrunk");
    for (int i = 0; i < 300; ++i) {
      const Eigen::Vector2d point(random.between(-1.6, 1.6), random.between(-1.6, 1.6));
      const double away = distance_to_outline(polygon, point);
      const bool is_inside = contains(polygon, point);
      const bool is_near = away < distance - kRounding;
      const bool is_far = away > kMitreLimit * distance + kRounding;
      if (is_inside || is_near) {
        EXPECT_TRUE(contains(grown, point)) << round;
      }
      if (!is_inside && is_far) {
        EXPECT_FALSE(contains(grown, point)) << round;
      }
      if (!is_inside || is_near) {
        EXPECT_FALSE(contains(shrunk, point)) << round;
      }
      if (is_inside && is_far) {
        EXPECT_TRUE(contains(shrunk, point)) << round;
      }
      kept += is_inside && is_far ? 1 : 0;
      lost += is_inside && is_near ? 1 : 0;
    }
  }
  EXPECT_GT(kept, 100);
  EXPECT_GT(lost, 100);
}

TEST(Offset, NothingIsLeftOfWhatIsThinnerThanTwiceTheDistance) {
  EXPECT_TRUE(offset(polygon_of({box_ring(0, 0, 30, 30)}), -0.005).empty()) << "turned round twice";
  EXPECT_TRUE(offset(polygon_of({box_ring(0, 0, 9000, 90)}), -0.005).empty()) << "and once";
  const Polygon left = offset(polygon_of({box_ring(0, 0, 9000, 120)}), -0.005);
  EXPECT_EQ(left, polygon_of({box_ring(50, 50, 8950, 70)}));
}

TEST(Offset, RefusesDistancesThatLeaveTheGrid) {
  const Polygon box = polygon_of({box_ring(0, 0, 10000, 10000)});
  EXPECT_THROW(offset(box, std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  EXPECT_THROW(offset(box, 1e6), std::invalid_argument);
}

}  // namespace
}  // namespace geomap::geometry
