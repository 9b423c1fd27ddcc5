// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <stdexcept>

#include "drivers/camera_mount.hpp"
#include "drivers/seven_scenes_source.hpp"
#include "logs/import_fixture.hpp"
#include "support/recordings.hpp"

namespace geomap::logs {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

class ImportPriors : public ImportTest {};

TEST(ForwardCameraMount, TheCameraLooksAlongTheBodysXWithItsYDown) {
  const Eigen::Isometry3d T_body_camera = drivers::forward_camera_mount();
  EXPECT_EQ(T_body_camera * Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX());
  EXPECT_EQ(T_body_camera * Eigen::Vector3d::UnitY(), -Eigen::Vector3d::UnitZ());
  EXPECT_DOUBLE_EQ(T_body_camera.linear().determinant(), 1.0);
}

TEST_F(ImportPriors, AFramesPosesStandBeforeIt) {
  const ImportedLog log = imported({});
  ASSERT_EQ(log.order.size(), 4U * kFrames);
  for (std::size_t i = 0; i < log.order.size(); i += 4) {
    EXPECT_THAT(std::vector(log.order.begin() + static_cast<std::ptrdiff_t>(i),
                            log.order.begin() + static_cast<std::ptrdiff_t>(i + 4)),
                ElementsAre("CAMERA_TO_BODY", "TRUTH_POSE", "POSE", "RGBD_FRAME"));
  }
}

TEST_F(ImportPriors, WithTruthAsPriorPoseAndMountMakeTheTruePose) {
  const ImportedLog log = imported({});
  for (int i = 0; i < kFrames; ++i) {
    const std::int64_t utime = drivers::seven_scenes_utime(i);
    expect_near(log.truth.at(utime), testing::some_pose(i));
    expect_near(log.pose.at(utime) * log.camera_to_body.at(utime), testing::some_pose(i));
    expect_near(log.camera_to_body.at(utime), drivers::forward_camera_mount());
  }
}

TEST_F(ImportPriors, WithoutPriorThereIsOnePoseAtTheFirstFrame) {
  ImportSettings settings;
  settings.prior = ImportPrior::kNone;
  const ImportedLog log = imported(settings);
  ASSERT_EQ(log.pose.size(), 1U);
  expect_near(log.pose.at(drivers::seven_scenes_utime(0)), true_body_pose(0));
  EXPECT_EQ(log.truth.size(), static_cast<std::size_t>(kFrames));
}

TEST_F(ImportPriors, ADriftingPriorFollowsTheDriftModelAndLeavesTheTruthAlone) {
  ImportSettings settings;
  settings.prior = ImportPrior::kDrift;
  settings.drift.drift_m_per_m = 0.1;
  const ImportedLog log = imported(settings);
  drivers::OdometryDrift drift(settings.drift);
  for (int i = 0; i < kFrames; ++i) {
    const std::int64_t utime = drivers::seven_scenes_utime(i);
    expect_near(log.pose.at(utime), drift.next(true_body_pose(i)));
    expect_near(log.truth.at(utime), testing::some_pose(i));
  }
  const std::int64_t last = drivers::seven_scenes_utime(kFrames - 1);
  EXPECT_GT((log.pose.at(last).translation() - log.truth.at(last).translation()).norm(), 0.02);
}

TEST_F(ImportPriors, TheDirectionGivenAsUpBecomesZAndNothingElseTurns) {
  ImportSettings settings;
  settings.up = Eigen::Vector3d(0.0061, -0.892, -0.451);
  const ImportedLog log = imported(settings);
  const std::int64_t utime = drivers::seven_scenes_utime(3);
  const Eigen::Isometry3d turn = log.truth.at(utime) * testing::some_pose(3).inverse();
  EXPECT_LT((turn * settings.up->normalized() - Eigen::Vector3d::UnitZ()).norm(), 1e-9);
  EXPECT_LT(turn.translation().norm(), 1e-9);
  // The smallest such rotation has its axis at right angles to both directions.
  const Eigen::AngleAxisd rotation(turn.linear());
  EXPECT_NEAR(rotation.axis().dot(Eigen::Vector3d::UnitZ()), 0.0, 1e-9);
  expect_near(log.pose.at(utime) * log.camera_to_body.at(utime), log.truth.at(utime));
}

TEST_F(ImportPriors, AnUpsideDownWorldIsTurnedOver) {
  ImportSettings settings;
  settings.up = Eigen::Vector3d(0.0, 0.0, -2.0);
  const ImportedLog log = imported(settings);
  const std::int64_t utime = drivers::seven_scenes_utime(1);
  EXPECT_NEAR(log.truth.at(utime).translation().z(), -testing::some_pose(1).translation().z(),
              1e-9);
}

TEST_F(ImportPriors, FramesBeforeTheFirstPoseAreLeftOutAndLaterOnesKept) {
  for (const int i : {0, 1, 3}) std::filesystem::remove(file(i, ".pose.txt"));
  const ImportSummary summary = import_with({});
  EXPECT_EQ(summary.frames, 3U);
  EXPECT_EQ(summary.frames_before_truth, 2U);
  EXPECT_EQ(summary.frames_without_truth, 1U);
  const ImportedLog log = read_log(out_);
  EXPECT_EQ(log.frames[0].utime, drivers::seven_scenes_utime(2));
  EXPECT_EQ(log.frames[0].sequence, 0);
  EXPECT_FALSE(log.pose.contains(drivers::seven_scenes_utime(3)));
  EXPECT_FALSE(log.truth.contains(drivers::seven_scenes_utime(3)));
}

TEST_F(ImportPriors, ADataSetWithoutPosesHasItsFirstBodyFrameAsWorld) {
  for (int i = 0; i < kFrames; ++i) std::filesystem::remove(file(i, ".pose.txt"));
  const ImportSummary summary = import_with({});
  EXPECT_EQ(summary.prior, ImportPrior::kNone);
  EXPECT_THAT(to_string(summary), HasSubstr("no true poses; prior: none"));
  const ImportedLog log = read_log(out_);
  EXPECT_THAT(log.truth, IsEmpty());
  ASSERT_EQ(log.pose.size(), 1U);
  expect_near(log.pose.at(drivers::seven_scenes_utime(0)), Eigen::Isometry3d::Identity());
  for (const ImportPrior prior : {ImportPrior::kTruth, ImportPrior::kDrift}) {
    ImportSettings settings;
    settings.prior = prior;
    EXPECT_THAT([&] { import_with(settings); },
                ThrowsMessage<std::runtime_error>(HasSubstr("needs true poses")));
  }
}

TEST(ImportRecording, TheRedKitchenStandsUprightAndKeepsItsPoses) {
  GEOMAP_REQUIRE_RECORDING(recording, "redkitchen");
  testing::TemporaryFolder folder;
  drivers::SevenScenesSource source(recording, {0, 9});
  ImportSettings settings;
  settings.up = Eigen::Vector3d(0.00612, -0.89238, -0.45124);
  const ImportSummary summary = import_frames(
      source, settings, (folder / "kitchen.lcmlog").string(), [](std::size_t) { return true; });
  EXPECT_EQ(summary.frames, 10U);
  EXPECT_LT(summary.largest_message, 190'000U);  // what every LCM tool can receive

  // The table top of reference_planes.yaml, as the recorded poses see it.
  const ImportedLog log = read_log(folder / "kitchen.lcmlog");
  ASSERT_EQ(log.frames.size(), 10U);
  drivers::SevenScenesSource again(recording, {0, 9});
  const Eigen::Vector3d table_in_data_set(0.014, -0.014, 1.821);
  for (const geometry::RgbdFrame& frame : log.frames) {
    const auto expected = again.next();
    EXPECT_EQ(frame.depth.millimetres, expected->frame.depth.millimetres);
    const Eigen::Isometry3d T_world_dataset =
        log.truth.at(frame.utime) * expected->truth_T_world_camera->inverse();
    EXPECT_NEAR((T_world_dataset * table_in_data_set).z(), -0.8086, 0.002);
    const Eigen::Vector3d view = log.pose.at(frame.utime).linear().col(0);
    EXPECT_LT(std::abs(view.z()), 0.9);  // the body looks about the room, not up or down
  }
}

}  // namespace
}  // namespace geomap::logs
