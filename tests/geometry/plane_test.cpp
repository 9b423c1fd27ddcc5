// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace geomap::geometry {
namespace {

using Eigen::Vector3d;

const Plane kPlane = Plane::through({1.0, -2.0, 3.0}, Vector3d(1.0, 2.0, -2.0) / 3.0);

TEST(Plane, ThroughAPointHoldsThatPoint) {
  EXPECT_NEAR(kPlane.signed_distance({1.0, -2.0, 3.0}), 0.0, 1e-12);
  EXPECT_NEAR(kPlane.signed_distance(Vector3d(1.0, -2.0, 3.0) + 0.7 * kPlane.normal), 0.7, 1e-12);
}

TEST(Plane, ProjectionLiesOnThePlaneBelowThePoint) {
  const Vector3d point(4.0, 5.0, -6.0), foot = kPlane.project(point);
  EXPECT_NEAR(kPlane.signed_distance(foot), 0.0, 1e-12);
  EXPECT_NEAR((point - foot).cross(kPlane.normal).norm(), 0.0, 1e-12);
}

TEST(Plane, FlippedIsTheSameSurfaceSeenFromTheOtherSide) {
  const Vector3d point(4.0, 5.0, -6.0);
  EXPECT_EQ(kPlane.flipped().signed_distance(point), -kPlane.signed_distance(point));
  EXPECT_LT((kPlane.flipped().project(point) - kPlane.project(point)).norm(), 1e-12);
  EXPECT_NEAR(angle_between(kPlane, kPlane.flipped()), std::numbers::pi, 1e-12);
}

TEST(Plane, TransformedKeepsSignedDistancesEvenAKilometreAway) {
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  T_target_source.rotate(Eigen::AngleAxisd(0.8, Vector3d(1.0, -2.0, 0.5).normalized()));
  T_target_source.pretranslate(Vector3d(1000.0, -700.0, 50.0));
  const Plane moved = kPlane.transformed(T_target_source);
  EXPECT_NEAR(moved.normal.norm(), 1.0, 1e-12);
  for (const Vector3d& p : {Vector3d(0.0, 0.0, 0.0), Vector3d(3.0, -1.0, 2.0)}) {
    EXPECT_NEAR(moved.signed_distance(T_target_source * p), kPlane.signed_distance(p), 1e-9);
  }
}

TEST(Plane, AngleIsExactForTinyTurns) {
  for (const double angle : {1e-9, 1e-5, 0.3, 1.5, 3.0}) {
    const Plane turned{{std::sin(angle), 0.0, std::cos(angle)}, 1.0};
    EXPECT_NEAR(angle_between(Plane{}, turned) / angle, 1.0, 1e-6);
  }
}

}  // namespace
}  // namespace geomap::geometry
