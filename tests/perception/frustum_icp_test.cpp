// SPDX-License-Identifier: BSD-3-Clause
#include "perception/frustum_icp.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <stdexcept>

#include "geometry/angles.hpp"
#include "perception/point_map.hpp"
#include "registration_scenes.hpp"

namespace geomap::perception {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

MotionSize size_of(const Motion& motion) {
  return {motion.translation.norm(), motion.rotation.norm()};
}

TEST(FrustumIcp, FindsTheCameraInARoomFromFiveCentimetresAndThreeDegreesAway) {
  Worst worst;
  for (const RegistrationScene& scene : near_and_far({room_scene()})) {
    const std::vector<Surfel> surfels = exact_surfels(scene);
    const SurfaceImage view = exact_view(scene, scene.T_world_camera);
    for (unsigned seed = 1; seed <= 15; ++seed) {
      const Alignment found =
          align(surfels, view, disturbed(scene.T_world_camera, 0.05, 3.0, seed));
      EXPECT_TRUE(found.converged);
      EXPECT_EQ(found.observed_directions, 6);
      worst.add(size_of(motion(scene.T_world_camera, found.T_world_camera)));
    }
  }
  EXPECT_LT(worst.metres, 0.002);
  EXPECT_LT(worst.degrees, 0.1);
  worst.record("room");
}

// In a room whose right direction hardly shows, an exact prior keeps the view from making it up.
TEST(FrustumIcp, AMeasuredPriorDecidesWhereTheViewTellsLittle) {
  const RegistrationScene scene = room_scene();
  const Isometry3d T_map = testing::look_at({0.6, -1.2, 1.3}, {-0.5, 1.3, 0.6});
  double free = 0.0, held = 0.0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    PointMap map;
    map.insert(1, noisy_frame(scene, T_map, seed), T_map);
    const FrameView view = map.view(noisy_frame(scene, scene.T_world_camera, 100 + seed));
    const auto all = map.voxels().surfels_in({testing::kinect_camera(), 0.1, 5.0, T_map});
    const auto error = [&](double hold_sigma) {
      const Alignment found =
          align(all.surfels, view.surfaces, scene.T_world_camera, {}, hold_sigma);
      return motion(scene.T_world_camera, found.T_world_camera).translation.norm();
    };
    free += error(0.0);
    held += error(0.001);
  }
  EXPECT_LT(held, 0.5 * free);
}

TEST(FrustumIcp, AMeasuredPriorThatIsPlainlyWrongGivesWay) {
  const RegistrationScene scene = room_scene();
  const std::vector<Surfel> surfels = exact_surfels(scene);
  const SurfaceImage view = exact_view(scene, scene.T_world_camera);
  for (unsigned seed = 1; seed <= 15; ++seed) {
    const Alignment found =
        align(surfels, view, disturbed(scene.T_world_camera, 0.05, 3.0, seed), {}, 0.01);
    EXPECT_TRUE(found.converged);
    EXPECT_LT(motion(scene.T_world_camera, found.T_world_camera).translation.norm(), 0.006);
  }
}

TEST(FrustumIcp, FindsTheCameraInAMapMadeFromAnotherNoisyView) {
  Worst worst;
  const RegistrationScene scene = room_scene();
  const Isometry3d T_map = testing::look_at({0.6, -1.2, 1.3}, {-0.5, 1.3, 0.6});
  for (unsigned seed = 1; seed <= 12; ++seed) {
    PointMap map;
    map.insert(1, noisy_frame(scene, T_map, seed), T_map);
    const FrameView view = map.view(noisy_frame(scene, scene.T_world_camera, 100 + seed));
    const auto all = map.voxels().surfels_in({testing::kinect_camera(), 0.1, 5.0, T_map});
    const Alignment found =
        align(all.surfels, view.surfaces, disturbed(scene.T_world_camera, 0.05, 3.0, seed));
    EXPECT_TRUE(found.converged);
    EXPECT_EQ(found.observed_directions, 6);
    worst.add(size_of(motion(scene.T_world_camera, found.T_world_camera)));
  }
  EXPECT_LT(worst.metres, 0.01);
  EXPECT_LT(worst.degrees, 0.5);
  worst.record("noisy room");
}

/// Floor and two walls, large: nothing in the view ends or hides anything.
RegistrationScene corner_scene() {
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  return {"corner",
          {{"floor", {4.0, 4.0, 0.0}, x, y, 4.0, 4.0, {}, {}},
           {"left", {0.0, 4.0, 4.0}, y, z, 4.0, 4.0, {}, {}},
           {"right", {4.0, 0.0, 4.0}, x, z, 4.0, 4.0, {}, {}}},
          testing::look_at({1.4, 1.6, 1.5}, {0.3, 0.2, 0.3}),
          {},
          {}};
}

// The step is -H⁻¹g: its derivative by a motion of the prior is minus the identity where, and only
// where, the Jacobian that H and g are made of is the residuals' true derivative.
TEST(FrustumIcp, AStepIsTheOppositeOfASmallMotionInEachOfTheSixDirections) {
  constexpr double kSize = 0.02;  // [m], [rad]
  const RegistrationScene scene = corner_scene();
  const std::vector<Surfel> surfels = exact_surfels(scene);
  const SurfaceImage view = exact_view(scene, scene.T_world_camera);
  FrustumIcpConfig one_step;
  one_step.max_iterations = 1;
  one_step.coarse_iterations = 0;
  one_step.coarse_gate = one_step.gate = 0.15;
  Eigen::Matrix<double, 6, 6> derivative;
  for (int i = 0; i < 6; ++i) {
    std::array<Eigen::Matrix<double, 6, 1>, 2> steps;
    for (const int side : {0, 1}) {
      const double size = side == 0 ? -kSize : kSize;
      Isometry3d prior = scene.T_world_camera;
      if (i < 3) prior.translation()(i) += size;
      if (i >= 3) prior.linear() = Eigen::AngleAxisd(size, Vector3d::Unit(i - 3)) * prior.linear();
      const Alignment found = align(surfels, view, prior, one_step);
      ASSERT_EQ(found.iterations, 1);
      const Motion step = motion(prior, found.T_world_camera);
      steps[static_cast<std::size_t>(side)] << step.translation, step.rotation;
    }
    derivative.col(i) = (steps[1] - steps[0]) / (2.0 * kSize);
  }
  const double error = (derivative + Eigen::Matrix<double, 6, 6>::Identity()).cwiseAbs().maxCoeff();
  EXPECT_LT(error, 0.05) << derivative;
  RecordProperty("largest error of the derivative", std::to_string(error));
}

TEST(FrustumIcp, ReportsHowGoodAPerfectAlignmentIs) {
  const RegistrationScene scene = room_scene();
  const Alignment found = align(exact_surfels(scene), exact_view(scene, scene.T_world_camera),
                                disturbed(scene.T_world_camera, 0.02, 1.0, 3));
  EXPECT_LT(found.rms, 0.003);
  EXPECT_GT(found.overlap, 0.95);
  EXPECT_GT(found.agreement, 0.95);
  EXPECT_GT(found.conditioning, 0.001);
  EXPECT_LE(found.conditioning, 1.0);
}

/// Nothing was aligned: the pose is the prior, bit by bit, and nothing is claimed of it.
void expect_nothing_found(const Alignment& found, const Isometry3d& prior) {
  EXPECT_EQ(found.T_world_camera.matrix(), prior.matrix());
  EXPECT_FALSE(found.converged);
  EXPECT_EQ(found.observed_directions, 0);
  EXPECT_EQ(found.overlap, 0.0);
}

TEST(FrustumIcp, FindsNothingWithoutSurfelsOrWithTooFew) {
  const RegistrationScene scene = room_scene();
  const SurfaceImage view = exact_view(scene, scene.T_world_camera);
  std::vector<Surfel> few = exact_surfels(scene);
  few.resize(20);
  expect_nothing_found(align({}, view, scene.T_world_camera), scene.T_world_camera);
  expect_nothing_found(align(few, view, scene.T_world_camera), scene.T_world_camera);
}

TEST(FrustumIcp, FindsNothingInAViewWithoutSurfaces) {
  const RegistrationScene scene = room_scene();
  RegistrationScene nothing = scene;
  nothing.rectangles.clear();
  const SurfaceImage view = exact_view(nothing, scene.T_world_camera);
  ASSERT_EQ(view.size(), 0);
  expect_nothing_found(align(exact_surfels(scene), view, scene.T_world_camera),
                       scene.T_world_camera);
}

TEST(FrustumIcp, FindsNothingWhereTheViewShowsNothingOfTheMap) {
  const RegistrationScene scene = room_scene();
  const SurfaceImage view = exact_view(scene, scene.T_world_camera);
  const Isometry3d away = testing::look_at({0.0, -1.0, 1.2}, {0.0, -5.0, 1.2});
  const Isometry3d far = Eigen::Translation3d(50.0, 0.0, 0.0) * scene.T_world_camera;
  expect_nothing_found(align(exact_surfels(scene), view, away), away);
  expect_nothing_found(align(exact_surfels(scene), view, far), far);
}

TEST(FrustumIcp, SurfelsThatAreNotNumbersChangeNothing) {
  const RegistrationScene scene = room_scene();
  const SurfaceImage view = exact_view(scene, scene.T_world_camera);
  const Isometry3d prior = disturbed(scene.T_world_camera, 0.02, 1.0, 4);
  const std::vector<Surfel> surfels = exact_surfels(scene);
  std::vector<Surfel> more = surfels;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 40; ++i) more.push_back({Vector3d::Constant(nan), Vector3d::UnitZ()});
  EXPECT_EQ(align(more, view, prior).T_world_camera.matrix(),
            align(surfels, view, prior).T_world_camera.matrix());
}

TEST(FrustumIcp, ThrowsForAPriorThatIsNoRigidMotion) {
  const RegistrationScene scene = room_scene();
  const SurfaceImage view = exact_view(scene, scene.T_world_camera);
  Isometry3d not_a_number = scene.T_world_camera;
  not_a_number.translation().x() = std::numeric_limits<double>::quiet_NaN();
  Isometry3d scaled = scene.T_world_camera;
  scaled.linear() *= 1.01;
  Isometry3d mirrored = scene.T_world_camera;
  mirrored.linear().col(0) *= -1.0;
  for (const Isometry3d& prior : {not_a_number, scaled, mirrored}) {
    EXPECT_THROW(align({}, view, prior), std::invalid_argument);
  }
}

TEST(FrustumIcp, TheResultIsARotationWhereThePriorIsOneToSevenDigits) {
  const RegistrationScene scene = room_scene();
  Isometry3d prior = disturbed(scene.T_world_camera, 0.02, 1.0, 5);
  prior.linear() += 1e-7 * Eigen::Matrix3d{{1.0, -2.0, 0.5}, {0.3, -1.0, 2.0}, {1.5, 0.7, -0.4}};
  const Alignment found =
      align(exact_surfels(scene), exact_view(scene, scene.T_world_camera), prior);
  const Eigen::Matrix3d R = found.T_world_camera.linear();
  EXPECT_TRUE(found.converged);
  EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(FrustumIcp, RefusesSettingsThatMakeNoSense) {
  EXPECT_TRUE(FrustumIcpConfig().validate().empty());
  FrustumIcpConfig config;
  config.max_iterations = 0;
  config.coarse_iterations = -1;
  config.gate = 0.2;
  config.max_normal_angle_deg = 0.0;
  config.prior_sigma = std::numeric_limits<double>::quiet_NaN();
  config.least_information = 1.0;
  EXPECT_EQ(config.validate().size(), 6U);
}

}  // namespace
}  // namespace geomap::perception
