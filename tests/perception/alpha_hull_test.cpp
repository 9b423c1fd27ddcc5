// SPDX-License-Identifier: BSD-3-Clause
#include "perception/alpha_hull.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "geometry/polygon_clip.hpp"

namespace geomap::perception {
namespace {

using Points = std::vector<Eigen::Vector2d>;

// A grid of points, `step` apart, on [x0, x1] x [y0, y1].
void add_grid(Points& points, double x0, double y0, double x1, double y1, double step) {
  const int columns = static_cast<int>(std::lround((x1 - x0) / step));
  const int rows = static_cast<int>(std::lround((y1 - y0) / step));
  for (int r = 0; r <= rows; ++r) {
    for (int c = 0; c <= columns; ++c) points.emplace_back(x0 + c * step, y0 + r * step);
  }
}

std::vector<std::vector<std::uint32_t>> hull(const Points& points, double radius) {
  return alpha_hull(points, std::vector<double>(points.size(), radius));
}

double signed_area(const Points& points, const std::vector<std::uint32_t>& ring) {
  double sum = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d& a = points[ring[i]];
    const Eigen::Vector2d& b = points[ring[(i + 1) % ring.size()]];
    sum += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return sum;
}

double total_area(const Points& points, const std::vector<std::vector<std::uint32_t>>& rings) {
  double sum = 0.0;
  for (const auto& ring : rings) sum += signed_area(points, ring);
  return sum;
}

TEST(AlphaHull, ASquareOfPointsHasItsSquareAsOnlyRing) {
  Points points;
  add_grid(points, 0.0, 0.0, 1.0, 1.0, 0.1);
  const auto rings = hull(points, 0.2);
  ASSERT_EQ(rings.size(), 1u);
  EXPECT_EQ(rings[0].size(), 40u);
  EXPECT_NEAR(signed_area(points, rings[0]), 1.0, 1e-12);
}

TEST(AlphaHull, AWideHoleStaysAsAClockwiseRing) {
  Points points;
  add_grid(points, 0.0, 0.0, 1.0, 1.0, 0.05);
  std::erase_if(points, [](const Eigen::Vector2d& p) {
    return p.x() > 0.31 && p.x() < 0.69 && p.y() > 0.31 && p.y() < 0.69;
  });
  const auto rings = hull(points, 0.1);
  ASSERT_EQ(rings.size(), 2u);
  std::vector<double> areas = {signed_area(points, rings[0]), signed_area(points, rings[1])};
  std::sort(areas.begin(), areas.end());
  EXPECT_NEAR(areas[0], -0.16, 0.021);  // the circle does not reach into the corners
  EXPECT_NEAR(areas[1], 1.0, 1e-12);
}

TEST(AlphaHull, AHoleNarrowerThanTheCircleIsClosed) {
  Points points;
  add_grid(points, 0.0, 0.0, 1.0, 1.0, 0.05);
  std::erase_if(points, [](const Eigen::Vector2d& p) {
    return (p - Eigen::Vector2d(0.5, 0.5)).norm() < 0.06;
  });
  EXPECT_EQ(hull(points, 0.11).size(), 1u);
}

TEST(AlphaHull, TwoIslandsAreTwoOuterRings) {
  Points points;
  add_grid(points, 0.0, 0.0, 0.4, 0.4, 0.1);
  add_grid(points, 0.9, 0.0, 1.3, 0.4, 0.1);
  const auto rings = hull(points, 0.15);
  ASSERT_EQ(rings.size(), 2u);
  for (const auto& ring : rings) EXPECT_NEAR(signed_area(points, ring), 0.16, 1e-12);
}

TEST(AlphaHull, AnLKeepsItsConcaveCorner) {
  Points points;
  add_grid(points, 0.0, 0.0, 1.0, 0.3, 0.05);
  add_grid(points, 0.0, 0.35, 0.3, 1.0, 0.05);
  EXPECT_NEAR(total_area(points, hull(points, 0.08)), 0.3 + 0.3 * 0.7, 0.006);
}

TEST(AlphaHull, RadiiMayDifferFromPointToPoint) {
  Points points;
  add_grid(points, 0.0, 0.0, 0.5, 0.5, 0.05);
  const std::size_t dense = points.size();
  add_grid(points, 2.0, 0.0, 4.0, 2.0, 0.5);
  std::vector<double> radius(points.size(), 0.5);
  std::fill_n(radius.begin(), dense, 0.05);
  EXPECT_NEAR(total_area(points, alpha_hull(points, radius)), 0.25 + 4.0, 1e-9);
  EXPECT_NEAR(total_area(points, hull(points, 0.05)), 0.25, 1e-9);
}

TEST(AlphaHull, PointsWithoutAreaHaveNoRing) {
  EXPECT_TRUE(hull({}, 1.0).empty());
  EXPECT_TRUE(hull({{0.0, 0.0}, {1.0, 0.0}}, 1.0).empty());
  EXPECT_TRUE(hull(Points(10, Eigen::Vector2d(0.3, 0.4)), 1.0).empty());
  Points line;
  for (int i = 0; i < 20; ++i) line.emplace_back(0.1 * i, 0.2 * i);
  EXPECT_TRUE(hull(line, 10.0).empty());
}

TEST(AlphaHull, CoincidingPointsChangeNothing) {
  Points points;
  add_grid(points, 0.0, 0.0, 1.0, 1.0, 0.1);
  Points twice = points;
  twice.insert(twice.end(), points.begin(), points.end());
  EXPECT_NEAR(total_area(twice, hull(twice, 0.2)), 1.0, 1e-12);
}

TEST(AlphaHull, WrongInputIsTheCallersMistake) {
  const Points points = {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}};
  EXPECT_THROW(alpha_hull(points, std::vector<double>(2, 1.0)), std::invalid_argument);
  EXPECT_THROW(hull(points, 0.0), std::invalid_argument);
  EXPECT_THROW(hull(points, std::nan("")), std::invalid_argument);
  EXPECT_THROW(hull({{0.0, 0.0}, {1.0, 0.0}, {0.0, INFINITY}}, 1.0), std::invalid_argument);
}

// Oracle: a point is in the alpha shape when a triangle of three of the points that holds it has an
// empty circumscribed circle no larger than the radius; tried over all triples.
bool is_covered(const Points& points, double radius, const Eigen::Vector2d& at) {
  const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      for (std::size_t k = j + 1; k < points.size(); ++k) {
        const Eigen::Vector2d &a = points[i], &b = points[j], &c = points[k];
        const double twice = cross(b - a, c - a);
        const double s = cross(b - a, at - a) / twice, t = cross(at - a, c - a) / twice;
        if (s < 0.0 || t < 0.0 || s + t > 1.0) continue;
        const Eigen::Vector2d ab = b - a, ac = c - a;
        const Eigen::Vector2d to_center(
            (ac.y() * ab.squaredNorm() - ab.y() * ac.squaredNorm()) / (2.0 * twice),
            (ab.x() * ac.squaredNorm() - ac.x() * ab.squaredNorm()) / (2.0 * twice));
        if (to_center.norm() > radius) continue;
        const bool is_empty = std::none_of(points.begin(), points.end(), [&](const auto& p) {
          return (p - a - to_center).norm() < to_center.norm() * (1.0 - 1e-9);
        });
        if (is_empty) return true;
      }
    }
  }
  return false;
}

TEST(AlphaHull, RandomPointsCoverWhatTheDefinitionSays) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int round = 0; round < 5; ++round) {
    Points points;
    for (int i = 0; i < 60; ++i) points.emplace_back(uniform(generator), uniform(generator));
    std::vector<geometry::Ring> rings;
    for (const auto& indices : hull(points, 0.09)) {
      geometry::Ring ring;
      for (const std::uint32_t i : indices) ring.push_back(geometry::to_grid(points[i]));
      rings.push_back(ring);
    }
    const auto polygon = geometry::from_rings(rings, geometry::FillRule::kNonZero);
    const auto inner = geometry::offset(polygon, -0.0005),
               outer = geometry::offset(polygon, 0.0005);
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector2d at(uniform(generator), uniform(generator));
      if (geometry::contains(inner, at) != geometry::contains(outer, at))
        continue;  // on the border
      EXPECT_EQ(geometry::contains(polygon, at), is_covered(points, 0.09, at));
    }
  }
}

}  // namespace
}  // namespace geomap::perception
