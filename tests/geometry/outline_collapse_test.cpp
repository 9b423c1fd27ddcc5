// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/outline_collapse.hpp"

#include <gtest/gtest.h>

#include "geometry/random_polygons.hpp"
#include "geometry/ring_contacts.hpp"

namespace geomap::geometry {
namespace {

using testing::box_ring;
using testing::polygon_of;
using testing::RandomShapes;

std::vector<Ring> collapsed(std::vector<Ring> rings, double tolerance,
                            const std::function<bool(GridPoint)>& is_fixed = {}) {
  OutlineCollapse outline(std::move(rings), tolerance, is_fixed);
  outline.run();
  return outline.rings();
}

TEST(OutlineCollapse, NoStepMakesRingsMeet) {
  RandomShapes random(1);
  for (int round = 0; round < 20; ++round) {
    // Two outlines 1 cm to 3 cm apart, and steps of up to 4 cm.
    const std::vector<Ring> rings = collapsed({random.jagged_ring(150, 0.004, {0.0, 0.0}),
                                               random.jagged_ring(140, 0.004, {0.0, 0.0}, 0.98)},
                                              400.0);
    const std::vector<const Ring*> both{&rings[0], &rings[1]};
    EXPECT_TRUE(find_contacts(both).none());
    EXPECT_LT(rings[0].size() + rings[1].size(), 100U);
  }
}

TEST(OutlineCollapse, ASmallRingInABumpStaysInside) {
  // A 1 m square with a bump 5 mm high, in which a fixed triangle sits; steps of up to 1 cm.
  const Ring outer{{0, 0},        {10000, 0},    {10000, 10000}, {5200, 10000},
                   {5000, 10050}, {4800, 10000}, {0, 10000}};
  const Ring triangle{{4990, 10010}, {5000, 10020}, {5010, 10010}};
  const auto is_corner_of_triangle = [&](GridPoint p) { return p.y > 10005 && p.y < 10050; };
  const std::vector<Ring> rings = collapsed({outer, triangle}, 100.0, is_corner_of_triangle);
  EXPECT_EQ(rings[1], triangle);
  EXPECT_TRUE(lies_inside(triangle, rings[0]));
  EXPECT_EQ(collapsed({outer}, 100.0)[0].size(), 4U) << "without it the bump goes";
}

TEST(OutlineCollapse, AChamferedCornerOfTheSameAreaBecomesOneVertex) {
  const Ring ring{{0, 0}, {10000, 0}, {10000, 9980}, {9980, 10000}, {0, 10000}};
  const std::vector<Ring> rings = collapsed({ring}, 50.0);
  ASSERT_EQ(rings[0].size(), 4U);
  EXPECT_NEAR(signed_area(rings[0]), signed_area(ring), kGridUnit * 1.0);
}

TEST(OutlineCollapse, ATriangleIsNeverTakenApart) {
  const Ring triangle{{0, 0}, {10, 0}, {0, 10}};
  EXPECT_EQ(collapsed({triangle}, 1000.0)[0], triangle);
  EXPECT_EQ(collapsed({box_ring(0, 0, 30, 20)}, 1000.0)[0].size(), 3U);
  EXPECT_TRUE(collapsed({}, 10.0).empty());
}

}  // namespace
}  // namespace geomap::geometry
