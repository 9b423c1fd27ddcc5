// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/clip_memo.hpp"

#include <gtest/gtest.h>

#include <random>

#include "geometry/polygon_clip.hpp"
#include "mapping/fuse.hpp"

namespace geomap::mapping {
namespace {

using geometry::Polygon;

Polygon random_polygon(std::mt19937& random) {
  std::uniform_real_distribution<double> at(-1.0, 1.0), size(0.1, 1.0);
  std::vector<geometry::Ring> rings;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d low(at(random), at(random));
    rings.push_back(geometry::rectangle(low, low + Eigen::Vector2d(size(random), size(random))));
  }
  return geometry::from_rings(rings, geometry::FillRule::kNonZero);
}

// Whether it remembers much, little or nothing, a memo says what the operation says.
TEST(ClipMemo, GivesWhatTheOperationsGiveHoweverLittleItHolds) {
  for (const std::size_t bytes : {0U, 3000U, 10'000'000U}) {
    ClipMemo memo(bytes);
    for (int round = 0; round < 3; ++round) {
      std::mt19937 random(7);
      for (int i = 0; i < 20; ++i) {
        const Polygon a = random_polygon(random), b = random_polygon(random);
        geometry::PlanarPolygon surface{geometry::Plane{}, geometry::PlaneFrame{}, a};
        surface.plane = surface.frame.plane();
        geometry::PlaneFrame other = surface.frame;
        other.origin = Eigen::Vector3d(0.1 * i, 0.2, 0.0);
        EXPECT_EQ(memo.in_frame(surface, other), surface.in_frame(other));
        surface.plane = geometry::Plane::through(Eigen::Vector3d::Zero(),
                                                 Eigen::Vector3d(0.2, 0.0, 1.0).normalized());
        EXPECT_EQ(memo.in_frame(surface, other), surface.in_frame(other));
        EXPECT_EQ(memo.united_outline(a, b, 0.01), united_outline(a, b, 0.01));
        EXPECT_EQ(memo.united_outline(b, a, 0.01), united_outline(b, a, 0.01));
        const geometry::AreaMoments overlap = memo.overlap(a, b, 0.03);
        const Polygon grown = geometry::area(a) < geometry::area(b)
                                  ? geometry::intersect(geometry::offset(a, 0.03), b)
                                  : geometry::intersect(a, geometry::offset(b, 0.03));
        EXPECT_EQ(overlap.area, geometry::area_moments(grown).area);
      }
    }
    EXPECT_EQ(memo.hits() > 0, bytes > 1'000'000U);
  }
}

}  // namespace
}  // namespace geomap::mapping
