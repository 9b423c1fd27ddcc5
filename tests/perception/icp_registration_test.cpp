// SPDX-License-Identifier: BSD-3-Clause
#include "perception/icp_registration.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "perception/rigid_transform.hpp"
#include "registration_scenes.hpp"

namespace geomap::perception {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using enum PriorSource;

/// A map of one view of a scene, and another view to be aligned with it.
struct Example {
  explicit Example(const RegistrationScene& shown)
      : scene(shown), T_true(disturbed(shown.T_world_camera, 0.1, 4.0, 9)) {
    map.insert(1, noisy_frame(scene, scene.T_world_camera, 1), scene.T_world_camera);
    frame = noisy_frame(scene, T_true, 2);
  }
  RegistrationResult align(const Isometry3d& prior, PriorSource source = kMeasured,
                           const IcpRegistrationConfig& config = {}) const {
    return IcpRegistration(config).align(map.view(frame), map.voxels(), prior, source);
  }
  RegistrationScene scene;
  Isometry3d T_true;
  PointMap map;
  geometry::RgbdFrame frame;
};

const Example& room() {
  static const Example example(room_scene());
  return example;
}

RegistrationScene wall_scene() { return degenerate_scenes().front(); }

/// Rejected for this reason, at the prior.
void expect_rejected(const RegistrationResult& result, RegistrationReason reason) {
  EXPECT_FALSE(result.accepted);
  EXPECT_EQ(to_string(result.reason), to_string(reason));
  const Eigen::Matrix4d pose = result.T_world_camera.matrix();
  const Eigen::Matrix4d prior = result.T_world_camera_prior.matrix();
  EXPECT_TRUE(pose.allFinite() ? pose == prior : !prior.allFinite());
}

TEST(IcpRegistration, TheFirstViewIsAcceptedAtItsPrior) {
  const Isometry3d prior = far_away();
  for (const PriorSource source : {kMeasured, kGuessed}) {
    const auto result =
        IcpRegistration().align(room().map.view(room().frame), VoxelMap(), prior, source);
    EXPECT_TRUE(result.accepted);
    EXPECT_EQ(to_string(result.reason), "first");
    EXPECT_EQ(result.T_world_camera.matrix(), prior.matrix());
    EXPECT_FALSE(result.alignment.has_value());
  }
}

TEST(IcpRegistration, AlignsAViewOfTheRoomWhateverThePriorsSource) {
  const Isometry3d prior = disturbed(room().T_true, 0.05, 3.0, 1);
  for (const PriorSource source : {kMeasured, kGuessed}) {
    const auto result = room().align(prior, source);
    EXPECT_TRUE(result.accepted);
    EXPECT_EQ(to_string(result.reason), "aligned");
    EXPECT_LT((result.T_world_camera.translation() - room().T_true.translation()).norm(),
              source == kMeasured ? 0.005 : 0.003);  // a measured prior pulls
    EXPECT_LT(angle_between(result.T_world_camera, room().T_true), 0.002);
    EXPECT_EQ(result.T_world_camera_prior.matrix(), prior.matrix());
    EXPECT_GT(result.blocks_visited, 100);
    EXPECT_GT(result.readings, 3000);
    ASSERT_TRUE(result.alignment.has_value());
    EXPECT_EQ(result.alignment->observed_directions, 6);
  }
}

TEST(IcpRegistration, GivesTheSameBitsEachTime) {
  const Isometry3d prior = disturbed(room().T_true, 0.05, 3.0, 2);
  EXPECT_EQ(room().align(prior).T_world_camera.matrix(),
            room().align(prior).T_world_camera.matrix());
}

TEST(IcpRegistration, RejectsAViewWithTooFewSurfaces) {
  IcpRegistrationConfig config;
  config.min_surfaces = 100'000;
  expect_rejected(room().align(room().T_true, kMeasured, config),
                  RegistrationReason::kTooFewReadings);
  geometry::RgbdFrame blind = room().frame;
  std::fill(blind.depth.millimetres.begin(), blind.depth.millimetres.end(), std::uint16_t{0});
  for (const VoxelMap& map : {VoxelMap(), room().map.voxels()}) {
    const auto result =
        IcpRegistration().align(room().map.view(blind), map, room().T_true, kMeasured);
    expect_rejected(result, RegistrationReason::kTooFewReadings);
    EXPECT_EQ(result.readings, 0);
  }
}

TEST(IcpRegistration, RejectsAPriorThatIsNoRigidMotionEvenBeforeThereIsAMap) {
  Isometry3d not_a_number = room().T_true;
  not_a_number.translation().z() = std::numeric_limits<double>::quiet_NaN();
  Isometry3d scaled = room().T_true;
  scaled.linear() *= 1.001;
  for (const Isometry3d& prior : {not_a_number, scaled}) {
    expect_rejected(room().align(prior), RegistrationReason::kInvalidPrior);
    expect_rejected(
        IcpRegistration().align(room().map.view(room().frame), VoxelMap(), prior, kMeasured),
        RegistrationReason::kInvalidPrior);
  }
}

TEST(IcpRegistration, RejectsAViewOfWhatTheMapDoesNotKnow) {
  const Isometry3d elsewhere = Eigen::Translation3d(30.0, 0.0, 0.0) * room().T_true;
  expect_rejected(room().align(elsewhere), RegistrationReason::kOverlapTooSmall);
}

TEST(IcpRegistration, RejectsPriorsAtTheEndOfTheWorldWithoutACrash) {
  for (const double far : {9.99e5, 1e7, 1e100, 1e300}) {
    const Isometry3d prior = Eigen::Translation3d(far, 0.0, 0.0) * room().T_true;
    expect_rejected(room().align(prior), RegistrationReason::kOverlapTooSmall);
  }
}

TEST(IcpRegistration, RejectsAViewThatLooksThroughTheMap) {
  // The map knows many plates before a wall; the view sees the wall alone.
  RegistrationScene plates = wall_scene();
  plates.T_world_camera = testing::look_at({0.0, 0.0, 1.0}, {0.0, 2.0, 1.0});
  const RegistrationScene wall = plates;
  for (int i = 0; i < 5; ++i) {
    plates.rectangles.push_back({"plate",
                                 {-0.9 + 0.45 * i, 1.2, 1.0},
                                 Vector3d::UnitX(),
                                 Vector3d::UnitZ(),
                                 0.19,
                                 1.0,
                                 {},
                                 {}});
  }
  Example example(plates);
  // A second view of the wall behind the plates, so that there are partners enough.
  const Isometry3d beside = testing::look_at({0.4, 1.4, 1.0}, {0.4, 2.0, 1.0});
  example.map.insert(2, noisy_frame(wall, beside, 3), beside);
  const auto result =
      IcpRegistration().align(example.map.view(noisy_frame(wall, wall.T_world_camera, 4)),
                              example.map.voxels(), wall.T_world_camera, kMeasured);
  expect_rejected(result, RegistrationReason::kSeenThrough);
}

TEST(IcpRegistration, RejectsAnAlignmentThatIsNotGoodEnoughForTheLimits) {
  const Isometry3d prior = disturbed(room().T_true, 0.05, 3.0, 1);
  IcpRegistrationConfig config;
  config.max_rms = 1e-5;
  expect_rejected(room().align(prior, kMeasured, config), RegistrationReason::kRmsTooLarge);
  config = {};
  config.icp.max_iterations = 1;
  expect_rejected(room().align(prior, kMeasured, config), RegistrationReason::kNotConverged);
  config = {};
  config.max_correction = 0.03;
  expect_rejected(room().align(prior, kMeasured, config), RegistrationReason::kTooFarFromPrior);
  config = {};
  config.max_correction_deg = 2.0;
  expect_rejected(room().align(prior, kMeasured, config), RegistrationReason::kTooFarFromPrior);
}

TEST(IcpRegistration, BeforeASingleWallOnlyAMeasuredPriorIsAccepted) {
  const Example wall(wall_scene());
  const Isometry3d prior = disturbed(wall.T_true, 0.02, 1.0, 3);
  expect_rejected(wall.align(prior, kGuessed), RegistrationReason::kUnderconstrained);
  const auto result = wall.align(prior, kMeasured);
  EXPECT_TRUE(result.accepted);
  EXPECT_EQ(to_string(result.reason), "aligned");
  ASSERT_TRUE(result.alignment.has_value());
  EXPECT_EQ(result.alignment->observed_directions, 3);
  const MotionSize made_up = open_part(wall.scene, motion(prior, result.T_world_camera));
  EXPECT_LT(made_up.metres, 0.005);
  EXPECT_LT(made_up.radians, 0.0035);
}

TEST(IcpRegistration, TellsWhatItFoundAlsoWhereItRejects) {
  const Example wall(wall_scene());
  const auto result = wall.align(disturbed(wall.T_true, 0.02, 1.0, 3), kGuessed);
  ASSERT_TRUE(result.alignment.has_value());
  EXPECT_GT(result.alignment->overlap, 0.5);
  EXPECT_GT(result.alignment->partners, 500);
}

TEST(IcpRegistration, RefusesSettingsThatMakeNoSense) {
  IcpRegistrationConfig config;
  config.min_surfaces = 0;
  config.min_overlap = 1.5;
  config.min_agreement = -0.1;
  config.max_rms = 0.0;
  config.max_correction = 0.0;
  config.max_correction_deg = std::numeric_limits<double>::quiet_NaN();
  config.margin = -1.0;
  config.icp.prior_sigma = 0.0;
  EXPECT_EQ(config.validate().size(), 8U);
  EXPECT_THROW(IcpRegistration{config}, std::invalid_argument);
}

}  // namespace
}  // namespace geomap::perception
