// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/snap_overlay.hpp"

#include <gtest/gtest.h>

#include <array>

#include "geometry/polygon_clip.hpp"
#include "geometry/random_polygons.hpp"

namespace geomap::geometry {
namespace {

using testing::box_ring;
using testing::RandomShapes;

bool in_either(int a, int b) { return a != 0 || b != 0; }
bool in_both(int a, int b) { return a != 0 && b != 0; }
bool in_odd(int a, int) { return a % 2 != 0; }

TEST(SnapOverlay, AgreesWithFollowedBordersOnOrdinaryShapes) {
  RandomShapes random(31);
  for (int round = 0; round < 50; ++round) {
    const std::array a{random.jagged_ring(60, 0.1, {0.0, 0.0})};
    const std::array b{random.jagged_ring(50, 0.1, {random.between(-1.0, 1.0), 0.4})};
    const Polygon first = from_rings(a, FillRule::kNonZero),
                  second = from_rings(b, FillRule::kNonZero);
    EXPECT_NEAR(area(snap_overlay(a, b, in_either)), area(unite(first, second)), 2e-4);
    EXPECT_NEAR(area(snap_overlay(a, b, in_both)), area(intersect(first, second)), 2e-4);
  }
}

TEST(SnapOverlay, IsValidHoweverManyEdgesCrossInOneGridCell) {
  RandomShapes random(32);
  for (int round = 0; round < 200; ++round) {
    Ring tangle;  // forty corners on a 30 x 30 grid: most crossings fall between the grid's points
    for (int i = 0; i < 40; ++i) {
      const std::int32_t x = random.below(30);
      tangle.push_back({x, random.below(30)});
    }
    const Polygon polygon = snap_overlay(std::array{tangle}, {}, in_odd);
    ASSERT_EQ(find_fault(polygon), "") << "round " << round;
    EXPECT_GT(area(polygon), 0.0);
  }
}

TEST(SnapOverlay, EqualAreasGiveEqualPolygonsHoweverTheyAreDrawn) {
  // A plate with a square hole that touches the outline in one point, drawn as two rings and as
  // one.
  const Ring outer = box_ring(0, 0, 100, 100);
  const Ring hole{{0, 50}, {30, 80}, {60, 50}, {30, 20}};
  const Ring in_one{{0, 0},   {100, 0}, {100, 100}, {0, 100}, {0, 50},
                    {30, 80}, {60, 50}, {30, 20},   {0, 50}};
  const Polygon expected = snap_overlay(std::array{outer, hole}, {}, in_odd);
  ASSERT_EQ(expected.parts.size(), 1U);
  EXPECT_EQ(expected.parts[0].holes.size(), 1U);
  EXPECT_EQ(snap_overlay(std::array{in_one}, {}, in_odd), expected);
}

TEST(SnapOverlay, AHoleTouchingTheOutlineTwiceCutsThePlateInTwo) {
  const Ring outer = box_ring(0, 0, 100, 100);
  const Ring hole{{0, 50}, {50, 80}, {100, 50}, {50, 20}};
  const Polygon polygon = snap_overlay(std::array{outer, hole}, {}, in_odd);
  EXPECT_EQ(find_fault(polygon), "");
  EXPECT_EQ(polygon.parts.size(), 2U);
}

TEST(SnapOverlay, WindingNumbersAreCountedForEachOperand) {
  const Ring square = box_ring(0, 0, 100, 100), inner = box_ring(20, 20, 60, 60);
  const auto twice = [](int a, int) { return a == 2; };
  EXPECT_EQ(snap_overlay(std::array{square, inner}, {}, twice).parts[0].outer, inner);
  const auto second_only = [](int a, int b) { return a == 0 && b == 1; };
  EXPECT_TRUE(snap_overlay(std::array{square}, std::array{inner}, second_only).empty());
}

TEST(SnapOverlay, NothingComesOfNothing) {
  EXPECT_TRUE(snap_overlay({}, {}, in_either).empty());
  EXPECT_TRUE(snap_overlay(std::array{Ring(10, {3, 3})}, {}, in_either).empty());
  EXPECT_TRUE(snap_overlay(std::array{Ring{{0, 0}, {9, 0}, {4, 0}}}, {}, in_either).empty());
}

}  // namespace
}  // namespace geomap::geometry
