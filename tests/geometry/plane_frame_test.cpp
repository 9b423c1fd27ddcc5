// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane_frame.hpp"

#include <gtest/gtest.h>

#include "geometry/random_polygons.hpp"

namespace geomap::geometry {
namespace {

using Eigen::Vector3d;

Vector3d any_direction(testing::RandomShapes& random) {
  return Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

void expect_right_handed(const PlaneFrame& frame) {
  EXPECT_NEAR(frame.normal.norm(), 1.0, 1e-12);
  EXPECT_NEAR(frame.x_axis.norm(), 1.0, 1e-12);
  EXPECT_NEAR(frame.x_axis.dot(frame.normal), 0.0, 1e-12);
  EXPECT_NEAR(frame.T_parent_plane().linear().determinant(), 1.0, 1e-12);
  EXPECT_NEAR((frame.y_axis() - frame.normal.cross(frame.x_axis)).norm(), 0.0, 1e-12);
}

TEST(PlaneFrame, IsRightHandedOnEveryPlaneAndRoundTrips) {
  testing::RandomShapes random(1);
  for (int i = 0; i < 500; ++i) {
    const Plane plane{any_direction(random), random.between(-1000.0, 1000.0)};
    const Vector3d near = 5.0 * any_direction(random);
    const PlaneFrame frame = PlaneFrame::on(plane, near, Vector3d::UnitX(), -Vector3d::UnitY());
    expect_right_handed(frame);
    EXPECT_NEAR(plane.signed_distance(frame.origin), 0.0, 1e-9);
    EXPECT_LT((frame.origin - plane.project(near)).norm(), 1e-9);
    EXPECT_LT(angle_between(frame.plane(), plane), 1e-12);
    EXPECT_NEAR(frame.plane().d, plane.d, 1e-9);
    const Vector3d point = 10.0 * any_direction(random);
    const Vector3d there_and_back = frame.T_parent_plane() * (frame.T_plane_parent() * point);
    EXPECT_LT((there_and_back - point).norm(), 1e-9);
    EXPECT_NEAR((frame.T_plane_parent() * point).z(), plane.signed_distance(point), 1e-9);
  }
}

TEST(PlaneFrame, XFollowsTheHint) {
  const Plane plane{Vector3d(0.3, 0.2, 1.0).normalized(), -1.0};
  const PlaneFrame frame =
      PlaneFrame::on(plane, Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY());
  const Vector3d expected = Vector3d::UnitX() - plane.normal.x() * plane.normal;
  EXPECT_LT((frame.x_axis - expected.normalized()).norm(), 1e-12);
}

TEST(PlaneFrame, AHintNearTheNormalFallsBackOnTheOtherOne) {
  for (const double lean : {0.0, 1e-9, 0.1, 0.2}) {
    const Plane plane{Vector3d(1.0, lean, 0.0).normalized(), 2.0};
    const PlaneFrame frame =
        PlaneFrame::on(plane, Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY());
    expect_right_handed(frame);
    // The y axis follows y_hint: x is that hint turned by -90 degrees.
    EXPECT_GT(frame.y_axis().dot(Vector3d::UnitY()), 0.9);
  }
}

TEST(PlaneFrame, TransformedMovesPointsOfThePlaneAlong) {
  testing::RandomShapes random(3);
  const PlaneFrame frame = PlaneFrame::on({any_direction(random), 1.5}, Vector3d::Zero(),
                                          Vector3d::UnitX(), Vector3d::UnitY());
  Eigen::Isometry3d T_target_parent = Eigen::Isometry3d::Identity();
  T_target_parent.rotate(Eigen::AngleAxisd(2.1, any_direction(random)));
  T_target_parent.pretranslate(Vector3d(1000.0, 20.0, -3.0));
  const PlaneFrame moved = frame.transformed(T_target_parent);
  expect_right_handed(moved);
  const Vector3d point(0.3, -0.7, 0.1);
  EXPECT_LT(
      (moved.T_parent_plane() * point - T_target_parent * (frame.T_parent_plane() * point)).norm(),
      1e-9);
}

}  // namespace
}  // namespace geomap::geometry
