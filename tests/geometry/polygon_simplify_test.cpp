// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/polygon_simplify.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "geometry/polygon_clip.hpp"
#include "geometry/random_polygons.hpp"

namespace geomap::geometry {
namespace {

using Eigen::Vector2d;
using testing::box_ring;
using testing::distance_to_outline;
using testing::polygon_of;
using testing::RandomShapes;

double farthest_from(const Polygon& outline, const Polygon& polygon) {
  double farthest = 0.0;
  for (const GridPoint p : vertices(polygon)) {
    farthest = std::max(farthest, distance_to_outline(outline, to_metres(p)));
  }
  return farthest;
}

// A rectangle of `width` x `height` [m], its border in small steps that scatter by `sigma` [m].
Polygon noisy_rectangle(RandomShapes& random, double width, double height, double sigma) {
  const Vector2d corners[] = {{0, 0}, {width, 0}, {width, height}, {0, height}};
  Ring ring;
  for (int side = 0; side < 4; ++side) {
    const Vector2d from = corners[side], to = corners[(side + 1) % 4];
    const Vector2d outwards = Vector2d((to - from).y(), -(to - from).x()).normalized();
    for (int i = 0; i < 40; ++i) {
      ring.push_back(to_grid(from + (i / 40.0) * (to - from) + sigma * random.normal() * outwards));
    }
  }
  return polygon_of({ring});
}

TEST(Simplify, EveryVertexStaysWithinTheTolerance) {
  RandomShapes random(1);
  for (const double tolerance : {0.003, 0.01, 0.03}) {
    for (int round = 0; round < 15; ++round) {
      const Polygon polygon = random.jagged_polygon(120, 0.01);
      const Polygon fewer = simplify(polygon, tolerance);
      EXPECT_EQ(find_fault(fewer), "");
      EXPECT_LE(farthest_from(fewer, polygon), tolerance * (1.0 + 1e-9));
      EXPECT_LE(farthest_from(polygon, fewer), tolerance * (1.0 + 1e-9));
      EXPECT_LT(vertex_count(fewer), vertex_count(polygon));
    }
  }
}

TEST(Simplify, ANoisyRectangleGetsFewVerticesAndKeepsItsArea) {
  RandomShapes random(2);
  double drift = 0.0;
  for (int round = 0; round < 20; ++round) {
    const Polygon polygon = noisy_rectangle(random, 1.2, 0.8, 0.002);
    const Polygon fewer = simplify(polygon, 0.01);
    EXPECT_LE(vertex_count(fewer), 8U);
    EXPECT_GE(vertex_count(fewer), 4U);
    drift += (area(fewer) - area(polygon)) / area(polygon) / 20;
  }
  EXPECT_LT(std::abs(drift), 2e-4);
}

TEST(Simplify, ADiscDoesNotShrink) {
  RandomShapes random(3);
  const Polygon disc = polygon_of({random.jagged_ring(300, 0.0, {0.0, 0.0})});
  const Polygon fewer = simplify(disc, 0.02);
  EXPECT_LT(vertex_count(fewer), 30U);
  EXPECT_NEAR(area(fewer), area(disc), 5e-4 * area(disc));
}

TEST(Simplify, FixedVerticesStay) {
  RandomShapes random(4);
  for (int round = 0; round < 20; ++round) {
    const Polygon polygon = random.jagged_polygon(120, 0.01);
    std::set<GridPoint> fixed;
    for (const GridPoint p : vertices(polygon)) {
      if (random.below(5) == 0) fixed.insert(p);
    }
    const Polygon fewer = simplify(polygon, 0.01, [&](GridPoint p) { return fixed.contains(p); });
    EXPECT_EQ(find_fault(fewer), "");
    EXPECT_LE(farthest_from(fewer, polygon), 0.01 * (1.0 + 1e-9));
    EXPECT_LT(vertex_count(fewer), vertex_count(polygon));
    const std::vector<GridPoint> left = vertices(fewer);
    for (const GridPoint p : fixed) {
      EXPECT_NE(std::find(left.begin(), left.end(), p), left.end());
    }
  }
}

TEST(Simplify, WithEveryVertexFixedNothingChanges) {
  RandomShapes random(5);
  const Polygon polygon = random.jagged_polygon(80, 0.02);
  EXPECT_EQ(simplify(polygon, 0.05, [](GridPoint) { return true; }), polygon);
}

TEST(Simplify, RingsThatAreCloseTogetherDoNotCross) {
  RandomShapes random(6);
  for (int round = 0; round < 30; ++round) {
    // A jagged frame 1 cm to 3 cm wide: the tolerance is as large as the frame.
    const Ring outer = random.jagged_ring(150, 0.004, {0.0, 0.0});
    const Polygon frame = polygon_of({outer, random.jagged_ring(140, 0.004, {0.0, 0.0}, 0.98)});
    const Polygon fewer = simplify(frame, 0.02);
    EXPECT_EQ(find_fault(fewer), "");
    EXPECT_LT(vertex_count(fewer), vertex_count(frame) / 2) << "the check may not give up";
    EXPECT_LE(farthest_from(fewer, frame), 0.02 * (1.0 + 1e-9));
  }
}

TEST(Simplify, HoldsTheInvariantWhereRingsTouch) {
  RandomShapes random(7);
  for (int round = 0; round < 300; ++round) {
    const Polygon polygon = random.coarse_polygon(100);
    for (const double tolerance : {0.005, 0.02, 0.08}) {
      EXPECT_EQ(find_fault(simplify(polygon, tolerance)), "") << round << ' ' << tolerance;
    }
  }
}

TEST(Simplify, SmallHolesAndPartsAreDroppedUnlessFixed) {
  const Polygon polygon =
      polygon_of({box_ring(0, 0, 10000, 10000), box_ring(2000, 2000, 2050, 2050),
                  box_ring(4000, 4000, 6000, 6000), box_ring(20000, 0, 20050, 50)});
  const Polygon kept = simplify(polygon, 0.01);
  ASSERT_EQ(kept.parts.size(), 1U);
  EXPECT_EQ(kept, polygon_of({box_ring(0, 0, 10000, 10000), box_ring(4000, 4000, 6000, 6000)}));
  EXPECT_EQ(simplify(polygon, 0.01, [](GridPoint) { return true; }), polygon);
}

TEST(Simplify, WithoutToleranceTheOutlineStays) {
  RandomShapes random(8);
  const Polygon polygon = random.jagged_polygon(60, 0.05);
  EXPECT_EQ(simplify(polygon, 0.0), polygon);
  EXPECT_TRUE(simplify({}, 0.01).empty());
}

TEST(Simplify, DoesNotDependOnWhereTheOriginIs) {
  RandomShapes random(9);
  const Polygon polygon = random.jagged_polygon(150, 0.01);
  constexpr std::int32_t kKilometre = 10000000;
  EXPECT_EQ(simplify(testing::shifted(polygon, kKilometre, kKilometre), 0.01),
            testing::shifted(simplify(polygon, 0.01), kKilometre, kKilometre));
}

TEST(Simplify, RefusesANegativeTolerance) {
  EXPECT_THROW(simplify({}, -0.1), std::invalid_argument);
  EXPECT_THROW(simplify({}, std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
}

}  // namespace
}  // namespace geomap::geometry
