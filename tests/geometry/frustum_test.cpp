// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/frustum.hpp"

#include <gtest/gtest.h>

#include "geometry/random_polygons.hpp"

namespace geomap::geometry {
namespace {

using Eigen::Vector3d;
using testing::RandomShapes;

const CameraModel kOffCentreCamera{640, 480, 585.0, 585.0, 310.0, 250.0};
constexpr double kNear = 0.5, kFar = 4.0;

// Somewhere, turned, a kilometre from the origin.
Eigen::Isometry3d far_pose() {
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  T_world_camera.rotate(Eigen::AngleAxisd(2.2, Vector3d(0.4, -1.0, 0.3).normalized()));
  T_world_camera.pretranslate(Vector3d(1000.0, -300.0, 20.0));
  return T_world_camera;
}

Vector3d any_point(RandomShapes& random) {
  return {random.between(-4.0, 4.0), random.between(-4.0, 4.0), random.between(-1.0, 5.0)};
}

TEST(Frustum, ContainsWhatProjectsIntoTheImageBetweenNearAndFar) {
  for (const Eigen::Isometry3d& T_world_camera : {Eigen::Isometry3d::Identity(), far_pose()}) {
    const Frustum frustum(kOffCentreCamera, kNear, kFar, T_world_camera);
    RandomShapes random(1);
    int inside = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vector3d p = any_point(random);
      const Eigen::Vector2d pixel = kOffCentreCamera.project(p);
      const bool expected = p.z() >= kNear && p.z() <= kFar && pixel.x() >= -0.5 &&
                            pixel.x() <= 639.5 && pixel.y() >= -0.5 && pixel.y() <= 479.5;
      EXPECT_EQ(frustum.contains(T_world_camera * p), expected) << p.transpose();
      inside += expected;
    }
    EXPECT_GT(inside, 500);
  }
}

TEST(Frustum, NeverMissesABoxThatHoldsAVisiblePoint) {
  const Eigen::Isometry3d T_world_camera = far_pose();
  const Frustum frustum(kOffCentreCamera, kNear, kFar, T_world_camera);
  RandomShapes random(2);
  int visible = 0, refused = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector3d p = T_world_camera * any_point(random);
    const Vector3d below(random.between(0.0, 0.5), random.between(0.0, 0.5),
                         random.between(0.0, 0.5));
    const Vector3d above(random.between(0.0, 0.5), random.between(0.0, 0.5),
                         random.between(0.0, 0.5));
    const bool meets = frustum.may_intersect({p - below, p + above});
    if (frustum.contains(p)) {
      ++visible;
      EXPECT_TRUE(meets);
    }
    refused += !meets;
  }
  EXPECT_GT(visible, 500);
  EXPECT_GT(refused, 5000) << "a test that lets every box through is of no use";
}

TEST(Frustum, RefusesBoxesBehindBesideAndBeyond) {
  const Frustum frustum(kOffCentreCamera, kNear, kFar, Eigen::Isometry3d::Identity());
  const auto box = [](double x, double y, double z) {
    return Eigen::AlignedBox3d(Vector3d(x, y, z), Vector3d(x + 0.1, y + 0.1, z + 0.1));
  };
  EXPECT_TRUE(frustum.may_intersect(box(0.0, 0.0, 2.0)));
  EXPECT_FALSE(frustum.may_intersect(box(0.0, 0.0, -2.0)));
  EXPECT_FALSE(frustum.may_intersect(box(0.0, 0.0, 4.1)));
  EXPECT_FALSE(frustum.may_intersect(box(3.0, 0.0, 2.0)));
  EXPECT_FALSE(frustum.may_intersect(box(0.0, -3.0, 2.0)));
  EXPECT_FALSE(frustum.may_intersect(Eigen::AlignedBox3d()));
  EXPECT_TRUE(frustum.may_intersect({Vector3d::Constant(-100.0), Vector3d::Constant(100.0)}));
}

TEST(Frustum, CornersLieOnThreePlanesEachInImageOrder) {
  const Frustum frustum(kOffCentreCamera, kNear, kFar, far_pose());
  const Eigen::Isometry3d T_camera_world = far_pose().inverse();
  for (std::size_t i = 0; i < 8; ++i) {
    int touched = 0;
    for (const Plane& plane : frustum.planes()) {
      touched += std::abs(plane.signed_distance(frustum.corners()[i])) < 1e-9;
    }
    EXPECT_EQ(touched, 3);
    const Vector3d corner = T_camera_world * frustum.corners()[i];
    EXPECT_NEAR(corner.z(), i < 4 ? kNear : kFar, 1e-9);
    EXPECT_EQ(corner.x() < 0.0, i % 4 == 0 || i % 4 == 3);
    EXPECT_EQ(corner.y() < 0.0, i % 4 < 2);
  }
}

TEST(Frustum, RefusesInvalidCamerasAndDepths) {
  const Eigen::Isometry3d identity = Eigen::Isometry3d::Identity();
  EXPECT_THROW(Frustum(CameraModel{}, kNear, kFar, identity), std::invalid_argument);
  EXPECT_THROW(Frustum(kOffCentreCamera, 0.0, kFar, identity), std::invalid_argument);
  EXPECT_THROW(Frustum(kOffCentreCamera, 2.0, 1.0, identity), std::invalid_argument);
}

}  // namespace
}  // namespace geomap::geometry
