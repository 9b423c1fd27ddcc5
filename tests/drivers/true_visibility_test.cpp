// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/true_visibility.hpp"

#include "drivers/simulated_kinect.hpp"
#include "support/plane_renderer.hpp"

namespace geomap::drivers {
namespace {

SceneFace face_at(const Eigen::Vector3d& corner, const Eigen::Vector3d& u,
                  const Eigen::Vector3d& v) {
  SceneFace face;
  face.corner = corner;
  face.u = u;
  face.v = v;
  return face;
}

// A wall at x = 3 that faces the origin, 4 m wide and high, and a camera at the origin that looks
// at its middle.
Scene wall_ahead() {
  Scene scene;
  scene.add_face("wall", {}, face_at({3.0, 2.0, -2.0}, {0.0, -4.0, 0.0}, {0.0, 0.0, 4.0}));
  return scene;
}

const Eigen::Isometry3d kAhead = testing::look_at({0, 0, 0}, {3, 0, 0});

Truth truth_of(const Scene& scene, const std::vector<Eigen::Isometry3d>& poses,
               const VisibilityConfig& config = {}) {
  const RayCaster caster(scene);
  TrueVisibility visibility(scene, caster, simulated_kinect(), config);
  for (const Eigen::Isometry3d& T_world_camera : poses) visibility.add(T_world_camera);
  return visibility.truth();
}

TEST(TrueVisibility, OfAWallIsSeenWhatIsInTheImage) {
  const Truth truth = truth_of(wall_ahead(), {kAhead});
  const TruthPlane& plane = truth.planes.at(0);
  EXPECT_EQ(plane.name, "wall");
  EXPECT_NEAR((plane.plane.normal - Eigen::Vector3d(-1, 0, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(plane.plane.d, 3.0, 1e-12);
  EXPECT_NEAR(plane.area, 16.0, 1e-6);
  const geometry::CameraModel camera = simulated_kinect();
  const double in_view = 3.0 * camera.width / camera.fx * 3.0 * camera.height / camera.fy;
  EXPECT_NEAR(plane.visible_area, in_view, 0.03 * in_view);
  EXPECT_TRUE(plane.seen);
  EXPECT_EQ(plane.visible.size(), 1U);
}

TEST(TrueVisibility, WhatStandsInBetweenHidesItsShadow) {
  Scene scene = wall_ahead();  // a board of 0.4 m x 0.3 m half way hides twice its size
  scene.add_face("board", {}, face_at({1.5, 0.2, -0.15}, {0.0, -0.4, 0.0}, {0.0, 0.0, 0.3}));
  const double open = truth_of(wall_ahead(), {kAhead}).planes[0].visible_area;
  const Truth truth = truth_of(scene, {kAhead});
  EXPECT_NEAR(open - truth.planes[0].visible_area, 0.8 * 0.6, 0.03);
  ASSERT_EQ(truth.planes[0].visible.size(), 1U);
  EXPECT_EQ(truth.planes[0].visible[0].holes.size(), 1U);
  EXPECT_NEAR(truth.planes[1].visible_area, 0.4 * 0.3, 1e-6);
}

TEST(TrueVisibility, BehindAndOutOfRangeNothingIsSeen) {
  Scene scene = wall_ahead();
  EXPECT_FALSE(truth_of(scene, {testing::look_at({6, 0, 0}, {3, 0, 0})}).planes[0].seen);
  VisibilityConfig config;
  config.max_range = 2.9;
  EXPECT_FALSE(truth_of(scene, {kAhead}, config).planes[0].seen);
  EXPECT_FALSE(truth_of(scene, {}).planes[0].seen);
}

TEST(TrueVisibility, TheBackOfAFaceWithTwoSidesIsAPlaneOfItsOwn) {
  Scene scene;
  SceneFace face = face_at({3.0, 2.0, -2.0}, {0.0, -4.0, 0.0}, {0.0, 0.0, 4.0});
  face.both_sides = true;
  face.openings.emplace_back(Eigen::Vector2d(2.2, 1.8), Eigen::Vector2d(2.6, 2.4));
  scene.add_face("wall", {}, face);
  const Truth truth = truth_of(scene, {testing::look_at({6, 0, 0}, {3, 0, 0})});
  ASSERT_EQ(truth.planes.size(), 2U);
  EXPECT_FALSE(truth.planes[0].seen);
  EXPECT_EQ(truth.planes[1].name, "wall_back");
  EXPECT_NEAR(truth.planes[1].plane.d, -3.0, 1e-12);
  ASSERT_EQ(truth.planes[1].visible.size(), 1U);
  ASSERT_EQ(truth.planes[1].visible[0].holes.size(), 1U);
  // The opening is where it was: y from -0.2 to -0.6.
  for (const Eigen::Vector3d& p : truth.planes[1].visible[0].holes[0]) {
    EXPECT_GT(p.y(), -0.65);
    EXPECT_LT(p.y(), -0.15);
  }
}

TEST(TrueVisibility, SmallMovesAddNothing) {
  const Eigen::Isometry3d a_little = testing::look_at({0, 0.05, 0}, {3, 0.05, 0});
  const Eigen::Isometry3d farther = testing::look_at({0, 0.3, 0}, {3, 0.3, 0});
  const double once = truth_of(wall_ahead(), {kAhead}).planes[0].visible_area;
  EXPECT_EQ(truth_of(wall_ahead(), {kAhead, a_little}).planes[0].visible_area, once);
  EXPECT_NEAR(truth_of(wall_ahead(), {kAhead, farther}).planes[0].visible_area - once, 0.3 * 2.36,
              0.03);
}

}  // namespace
}  // namespace geomap::drivers
