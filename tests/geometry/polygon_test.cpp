// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/polygon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "geometry/polygon_clip.hpp"
#include "geometry/random_polygons.hpp"

namespace geomap::geometry {
namespace {

using Eigen::Vector2d;
using testing::box_ring;
using testing::polygon_of;
using testing::RandomShapes;

Ring reversed(Ring ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

// A 2 m x 1 m plate with a 0.5 m square hole.
Polygon plate() {
  return {{{box_ring(0, 0, 20000, 10000), {reversed(box_ring(2000, 2000, 7000, 7000))}}}};
}

TEST(Grid, RoundsToTheNearestTenthOfAMillimetre) {
  EXPECT_EQ(to_grid({0.12344, -0.12346}), (GridPoint{1234, -1235}));
  EXPECT_EQ(to_metres({12345, -1}), Vector2d(12345 * kGridUnit, -1 * kGridUnit));
}

TEST(Grid, RoundTripOfEveryGridPointIsExact) {
  RandomShapes random(3);
  for (int i = 0; i < 2000; ++i) {
    const GridPoint p{random.below(2000000000) - 1000000000, random.below(2000000000) - 1000000000};
    EXPECT_EQ(to_grid(to_metres(p)), p);
  }
}

TEST(Grid, RefusesWhatIsNotFiniteOrTooFar) {
  EXPECT_THROW(to_grid({std::numeric_limits<double>::quiet_NaN(), 0.0}), std::invalid_argument);
  EXPECT_THROW(to_grid({0.0, std::numeric_limits<double>::infinity()}), std::invalid_argument);
  EXPECT_THROW(to_grid({100001.0, 0.0}), std::invalid_argument);
}

TEST(PolygonArea, CountsHolesAsMissing) {
  EXPECT_DOUBLE_EQ(area(plate()), 2.0 - 0.25);
  EXPECT_DOUBLE_EQ(signed_area(reversed(box_ring(0, 0, 10000, 10000))), -1.0);
  EXPECT_EQ(area(Polygon{}), 0.0);
}

TEST(PolygonArea, IsExactAtTheEdgeOfTheGrid) {
  constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
  constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min();
  EXPECT_DOUBLE_EQ(signed_area({{kMost - 1, kMost - 1}, {kMost, kMost - 1}, {kMost, kMost}}),
                   0.5 * kGridUnit * kGridUnit);
  const double side = 4294967295.0 * kGridUnit;
  EXPECT_DOUBLE_EQ(signed_area(box_ring(kLeast, kLeast, kMost, kMost)), side * side);
}

TEST(PolygonMoments, OfARectangleAreTheTextbooks) {
  const Polygon box{{{box_ring(1000, 2000, 21000, 8000), {}}}};  // 2 m x 0.6 m
  const AreaMoments moments = area_moments(box);
  EXPECT_NEAR(moments.area, 1.2, 1e-12);
  EXPECT_NEAR((moments.centroid - Vector2d(1.1, 0.5)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(moments.covariance(0, 0), 4.0 / 12.0, 1e-12);
  EXPECT_NEAR(moments.covariance(1, 1), 0.36 / 12.0, 1e-12);
  EXPECT_NEAR(moments.covariance(0, 1), 0.0, 1e-12);
}

TEST(PolygonMoments, AgreeWithACountOfSmallSquares) {
  RandomShapes random(5);
  const Polygon polygon = random.jagged_polygon(40, 0.2);
  constexpr double kStep = 0.005;
  double count = 0.0;
  Vector2d first = Vector2d::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  for (double x = -1.3; x < 1.3; x += kStep) {
    for (double y = -1.3; y < 1.3; y += kStep) {
      const Vector2d p(x + 0.0011, y + 0.0007);
      if (!contains(polygon, p)) continue;
      count += 1.0;
      first += p;
      second += p * p.transpose();
    }
  }
  const AreaMoments moments = area_moments(polygon);
  const Vector2d mean = first / count;
  EXPECT_NEAR(moments.area, count * kStep * kStep, 0.005);
  EXPECT_LT((moments.centroid - mean).norm(), 0.002);
  EXPECT_LT((moments.covariance - (second / count - mean * mean.transpose())).norm(), 0.002);
}

TEST(PolygonMoments, DoNotLoseDigitsFarFromTheOrigin) {
  RandomShapes random(6);
  const Polygon near = random.jagged_polygon(60, 0.1);
  const AreaMoments here = area_moments(near);
  const AreaMoments there = area_moments(testing::shifted(near, 1000000000, -900000000));
  EXPECT_EQ(here.area, there.area);
  EXPECT_LT((there.covariance - here.covariance).norm(), 1e-9);
  EXPECT_LT((there.centroid - here.centroid - Vector2d(1e5, -9e4)).norm(), 1e-9);
}

TEST(PolygonContains, CountsTheBorderAndLeavesHolesOpen) {
  const Polygon polygon = plate();
  EXPECT_TRUE(contains(polygon, {1.5, 0.5}));
  EXPECT_FALSE(contains(polygon, {0.4, 0.4}));
  EXPECT_FALSE(contains(polygon, {2.1, 0.5}));
  EXPECT_TRUE(contains(polygon, {2.0, 1.0}));
  EXPECT_TRUE(contains(polygon, {0.3, 0.2}));
  EXPECT_TRUE(contains(polygon, {0.7, 0.7}));
  EXPECT_FALSE(contains(Polygon{}, {0.0, 0.0}));
}

TEST(PolygonContains, AgreesWithTheTurnsOfTheOutlineAboutThePoint) {
  RandomShapes random(11);
  const Polygon polygon = random.jagged_polygon(50, 0.3, {3.0, -2.0});
  const auto turns = [](const Ring& ring, const Vector2d& at) {
    double angle = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vector2d p = to_metres(ring[i]) - at, q = to_metres(ring[(i + 1) % ring.size()]) - at;
      angle += std::atan2(p.x() * q.y() - p.y() * q.x(), p.dot(q));
    }
    return std::lround(angle / 6.283185307179586);
  };
  int inside = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vector2d p(random.between(1.5, 4.5), random.between(-3.5, -0.5));
    long sum = 0;
    for (const PolygonPart& part : polygon.parts) {
      sum += turns(part.outer, p);
      for (const Ring& hole : part.holes) sum += turns(hole, p);
    }
    EXPECT_EQ(contains(polygon, p), sum == 1) << p.transpose();
    inside += sum == 1;
  }
  EXPECT_GT(inside, 1000);
  EXPECT_LT(inside, 4000);
}

TEST(PolygonContains, FindsEveryVertexOnTheBorder) {
  RandomShapes random(12);
  const Polygon polygon = testing::shifted(random.jagged_polygon(50, 0.3), 10000000, 10000000);
  for (const GridPoint p : polygon.parts[0].outer) EXPECT_TRUE(contains(polygon, to_metres(p)));
}

TEST(IsSimple, TellsCrossingTouchingAndRepeatedVertices) {
  EXPECT_TRUE(is_simple(box_ring(0, 0, 10, 10)));
  EXPECT_TRUE(is_simple(reversed(box_ring(0, 0, 10, 10))));
  EXPECT_FALSE(is_simple({{0, 0}, {10, 10}, {10, 0}, {0, 10}})) << "bow tie";
  EXPECT_FALSE(is_simple({{0, 0}, {10, 0}, {10, 10}, {5, 0}, {0, 10}})) << "vertex on an edge";
  EXPECT_FALSE(is_simple({{0, 0}, {5, 5}, {10, 0}, {10, 10}, {5, 5}, {0, 10}})) << "figure eight";
  EXPECT_FALSE(is_simple({{0, 0}, {10, 0}, {10, 0}, {0, 10}})) << "repeated vertex";
  EXPECT_FALSE(is_simple({{0, 0}, {10, 0}, {20, 0}})) << "flat";
  EXPECT_FALSE(is_simple({{0, 0}, {10, 0}, {10, 10}, {10, 5}})) << "spike";
  EXPECT_FALSE(is_simple({{0, 0}, {10, 0}}));
  EXPECT_FALSE(is_simple({}));
  EXPECT_TRUE(is_simple({{0, 0}, {5, 0}, {10, 0}, {0, 10}})) << "a vertex on a straight border";
}

TEST(IsSimple, AgreesWithEveryPairOfEdges) {
  RandomShapes random(17);
  const auto cross = [](GridPoint a, GridPoint b, GridPoint c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  };
  const auto sign = [](int v) { return (v > 0) - (v < 0); };
  int simple = 0;
  for (int round = 0; round < 3000; ++round) {
    const Ring ring = random.coarse_ring(5, 1);
    // General position only: no three of the corners on a line, so that edges cross or stay apart.
    bool is_general = true, crosses = false;
    for (std::size_t i = 0; i < 5; ++i) {
      for (std::size_t j = i + 1; j < 5; ++j) {
        for (std::size_t k = j + 1; k < 5; ++k) {
          is_general = is_general && cross(ring[i], ring[j], ring[k]) != 0;
        }
      }
    }
    if (!is_general) continue;
    for (std::size_t i = 0; i < 5; ++i) {
      const GridPoint a = ring[i], b = ring[(i + 1) % 5], c = ring[(i + 2) % 5],
                      d = ring[(i + 3) % 5], e = ring[(i + 4) % 5];
      for (const auto& [p, q] : {std::pair{c, d}, std::pair{d, e}}) {
        crosses = crosses || (sign(cross(a, b, p)) != sign(cross(a, b, q)) &&
                              sign(cross(p, q, a)) != sign(cross(p, q, b)));
      }
    }
    EXPECT_EQ(is_simple(ring), !crosses);
    simple += !crosses;
  }
  EXPECT_GT(simple, 50);
}

TEST(FindFault, AcceptsWhatTheInvariantAllows) {
  EXPECT_EQ(find_fault(Polygon{}), "");
  EXPECT_EQ(find_fault(plate()), "");
  const Polygon hole_touches_outline{{{box_ring(0, 0, 100, 100), {{{0, 50}, {20, 60}, {20, 40}}}}}};
  EXPECT_EQ(find_fault(hole_touches_outline), "");
  const Polygon island{{{box_ring(0, 0, 100, 100), {reversed(box_ring(10, 10, 90, 90))}},
                        {box_ring(40, 40, 60, 60), {}}}};
  EXPECT_EQ(find_fault(island), "");
}

TEST(FindFault, NamesEveryBreachOfTheInvariant) {
  const auto part = [](Ring outer, std::vector<Ring> holes = {}) {
    return PolygonPart{std::move(outer), std::move(holes)};
  };
  const Ring big = box_ring(0, 0, 100, 100);
  const auto fault = [&](std::vector<PolygonPart> parts) { return find_fault({std::move(parts)}); };
  EXPECT_NE(fault({part({{0, 0}, {1, 1}})}), "");
  EXPECT_NE(fault({part({})}), "");
  EXPECT_NE(fault({part(reversed(big))}), "") << "clockwise outer ring";
  EXPECT_NE(fault({part(big, {box_ring(10, 10, 20, 20)})}), "") << "counter-clockwise hole";
  EXPECT_NE(fault({part({{0, 0}, {10, 10}, {10, 0}, {0, 10}})}), "") << "bow tie";
  EXPECT_NE(fault({part(big, {reversed(box_ring(200, 10, 220, 20))})}), "") << "hole outside";
  EXPECT_NE(fault({part(big, {reversed(box_ring(90, 10, 120, 20))})}), "") << "hole crosses";
  EXPECT_NE(fault({part(big, {reversed(box_ring(0, 10, 20, 20))})}), "") << "shared stretch";
  EXPECT_NE(fault({part(big), part(box_ring(100, 0, 200, 100))}), "") << "shared edge";
  EXPECT_NE(fault({part(big), part(box_ring(10, 10, 20, 20))}), "") << "part inside a part";
  EXPECT_NE(fault({part(big), part(box_ring(50, 50, 150, 150))}), "") << "parts overlap";
  EXPECT_NE(
      fault({part(big, {reversed(box_ring(10, 10, 90, 90)), reversed(box_ring(20, 20, 30, 30))})}),
      "")
      << "hole in a hole";
  EXPECT_NE(fault({part(big, {{{0, 50}, {-20, 60}, {-20, 40}}})}), "") << "touches from outside";
  EXPECT_NE(fault({part({{0, 0}, {100, 0}, {50, 50}, {100, 100}, {0, 100}}),
                   part({{50, 50}, {20, 60}, {20, 40}})}),
            "")
      << "touching, but inside";
}

TEST(FindFault, SeesRingsThatCrossInCommonPointsOnly) {
  // The second ring leaves the box and comes back through two points of its border.
  const Polygon box_and = {
      {{box_ring(0, 0, 100, 100), {}}, {{{100, 50}, {150, 150}, {50, 100}, {50, 50}}, {}}}};
  EXPECT_EQ(find_fault(box_and), "two rings cross or share a stretch");
  Polygon with_vertices = box_and;
  with_vertices.parts[0].outer = {{0, 0}, {100, 0}, {100, 50}, {100, 100}, {50, 100}, {0, 100}};
  EXPECT_EQ(find_fault(with_vertices), "two rings cross or share a stretch");
}

TEST(Canonical, MakesEqualAreasEqual) {
  const Ring a = box_ring(0, 0, 100, 100), b = box_ring(200, 0, 300, 100);
  const Polygon one{{{b, {}}, {a, {}}}};
  const Polygon other{{{{a[2], a[3], a[0], a[1]}, {}}, {{b[1], b[2], b[3], b[0]}, {}}}};
  EXPECT_FALSE(one == other);
  EXPECT_EQ(canonical(one), canonical(other));
  EXPECT_EQ(canonical(one).parts[0].outer[0], (GridPoint{0, 0}));
}

TEST(PolygonBox, HoldsEveryPart) {
  const Polygon two{{{box_ring(-100, 0, 100, 100), {}}, {box_ring(200, -300, 300, 100), {}}}};
  EXPECT_EQ(bounding_box(two).min(), to_metres({-100, -300}));
  EXPECT_EQ(bounding_box(two).max(), to_metres({300, 100}));
  EXPECT_TRUE(bounding_box(Polygon{}).isEmpty());
  EXPECT_EQ(vertex_count(two), 8U);
  EXPECT_EQ(vertex_count(plate()), 8U);
}

}  // namespace
}  // namespace geomap::geometry
