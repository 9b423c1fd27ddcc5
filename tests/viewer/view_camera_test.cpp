// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/view_camera.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "viewer/view_control.hpp"

namespace geomap::viewer {
namespace {

ViewCamera random_camera(std::mt19937& random, Projection projection) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  ViewCamera camera;
  camera.resize(900, 600);
  camera.set({{10.0 * unit(random), 10.0 * unit(random), unit(random)},
              6.0 + 4.0 * unit(random),
              3.0 * unit(random),
              1.5 * unit(random),
              projection});
  return camera;
}

class EitherProjection : public ::testing::TestWithParam<Projection> {};
INSTANTIATE_TEST_SUITE_P(ViewCamera, EitherProjection,
                         ::testing::Values(Projection::kPerspective, Projection::kOrthographic));

TEST_P(EitherProjection, TheRayOfAPixelGoesThroughWhatIsDrawnThere) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> across(0.0, 900.0), down(0.0, 600.0), away(1.0, 30.0);
  for (int i = 0; i < 200; ++i) {
    const ViewCamera camera = random_camera(random, GetParam());
    const Eigen::Vector2d pixel(across(random), down(random));
    const auto seen = camera.project(camera.ray(pixel).at(away(random)));
    ASSERT_TRUE(seen);
    EXPECT_LT((*seen - pixel).norm(), 1e-6);
  }
}

TEST_P(EitherProjection, AShiftKeepsWhatIsUnderTheMouse) {
  std::mt19937 random(2);
  for (int i = 0; i < 50; ++i) {
    ViewCamera camera = random_camera(random, GetParam());
    const Eigen::Vector3d target = camera.viewpoint().target;
    const Eigen::Vector2d before = *camera.project(target);
    camera.pan(37.0, -21.0);
    EXPECT_LT((*camera.project(target) - before - Eigen::Vector2d(37.0, -21.0)).norm(), 1e-6);
  }
}

TEST_P(EitherProjection, ZoomingKeepsTheTargetsPlaneUnderTheMouse) {
  std::mt19937 random(3);
  ViewCamera camera = random_camera(random, GetParam());
  const Eigen::Vector2d pixel(700.0, 100.0);
  const Ray ray = camera.ray(pixel);
  const double depth = (camera.viewpoint().target - ray.origin).dot(camera.forward()) /
                       ray.direction.dot(camera.forward());
  const Eigen::Vector3d point = ray.at(depth);
  camera.zoom(0.5, pixel);
  EXPECT_LT((*camera.project(point) - pixel).norm(), 1e-6);
}

TEST_P(EitherProjection, AFittedBoxIsWhollyInView) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 100; ++i) {
    ViewCamera camera = random_camera(random, GetParam());
    Eigen::AlignedBox3d box;
    for (int corner = 0; corner < 2; ++corner) {
      box.extend(Eigen::Vector3d(8.0 * unit(random), 5.0 * unit(random), 2.0 * unit(random)));
    }
    camera.set(camera.fitting(box));
    for (int corner = 0; corner < 8; ++corner) {
      const auto pixel =
          camera.project(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
      ASSERT_TRUE(pixel);
      EXPECT_GE(pixel->minCoeff(), 0.0);
      EXPECT_LE(pixel->x(), 900.0);
      EXPECT_LE(pixel->y(), 600.0);
    }
  }
}

TEST(ViewCamera, FromAboveXIsToTheRightAndYIsUp) {
  ViewCamera camera;
  camera.set(
      {{0, 0, 0}, 5.0, -std::numbers::pi / 2.0, std::numbers::pi / 2.0, Projection::kOrthographic});
  const Eigen::Vector2d center = *camera.project({0, 0, 0});
  EXPECT_GT(camera.project({1, 0, 0})->x(), center.x() + 10.0);
  EXPECT_LT(camera.project({0, 1, 0})->y(), center.y() - 10.0);
  EXPECT_NEAR((*camera.project({0, 0, 2}) - center).norm(), 0.0, 1e-6);
}

TEST(ViewCamera, FromTheRobotsCameraTheImageIsUpright) {
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  T_world_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;  // looks along x, z up
  ViewCamera camera;
  camera.look_from(T_world_camera, 0.8);
  const Eigen::Vector2d ahead = *camera.project({2, 0, 0});
  EXPECT_LT((ahead - Eigen::Vector2d(640.0, 400.0)).norm(), 1e-6);
  EXPECT_LT(camera.project({2, 0.5, 0})->x(), ahead.x()) << "left is left";
  EXPECT_LT(camera.project({2, 0, 0.5})->y(), ahead.y()) << "up is up";
  EXPECT_FALSE(camera.project({-1, 0, 0}));
  camera.look_from(std::nullopt, 0.0);
  EXPECT_FALSE(camera.is_first_person());
}

TEST(ViewCamera, AFlightEndsWhereItWasToAndTurnsTheShortWay) {
  const Viewpoint from{{0, 0, 0}, 2.0, 3.0, 0.1, Projection::kPerspective};
  const Viewpoint to{{4, 0, 0}, 8.0, -3.0, 0.5, Projection::kPerspective};
  EXPECT_EQ(between(from, to, 1.0), to);
  const Viewpoint halfway = between(from, to, 0.5);
  EXPECT_NEAR(halfway.distance, 4.0, 1e-12);
  EXPECT_GT(std::abs(halfway.yaw), 3.0);
}

TEST(ViewCamera, AViewpointIsTheSameAfterBeingKeptAsText) {
  const Viewpoint viewpoint{
      {1.25, -3.1, 0.7}, 4.2, 0.123456789012345, -0.3, Projection::kOrthographic};
  EXPECT_EQ(viewpoint_from(to_text(viewpoint)), viewpoint);
  for (const char* text : {"", "1 2 3", "a b c d e f perspective", "1 2 3 -4 5 6 perspective",
                           "1 2 3 4 5 6 fisheye", "nan 2 3 4 5 6 perspective"}) {
    EXPECT_FALSE(viewpoint_from(text)) << text;
  }
}

}  // namespace
}  // namespace geomap::viewer
