// SPDX-License-Identifier: BSD-3-Clause
#include "perception/pose_prior.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace geomap::perception {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr std::int64_t kFirst = 1'000'000'000'000'000;
constexpr std::int64_t kMs = 1'000;

/// A body that turns at 0.5 rad/s about a slanting axis and moves at 1 m/s: constant velocity, so
/// that the pose at any time is known in closed form.
Isometry3d screw(std::int64_t utime) {
  const double seconds = static_cast<double>(utime - kFirst) * 1e-6;
  Isometry3d T = Isometry3d::Identity();
  T.translate(Vector3d(4.0, -1.0, 0.5) + seconds * Vector3d(0.6, 0.0, 0.8));
  T.rotate(AngleAxisd(2.9, Vector3d::UnitZ()));  // where quaternions of both signs are met
  T.rotate(AngleAxisd(0.5 * seconds, Vector3d(1.0, 2.0, 2.0) / 3.0));
  return T;
}

/// T_body_camera of the default configuration: x right = -y, y down = -z, z forward = x of the
/// body.
Isometry3d forward_camera() {
  Isometry3d T = Isometry3d::Identity();
  T.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return T;
}

void expect_same(const Isometry3d& actual, const Isometry3d& expected) {
  EXPECT_LT((actual.matrix() - expected.matrix()).cwiseAbs().maxCoeff(), 1e-9);
}

/// POSE of the screw motion every `step`, from kFirst on, `count` of them.
PosePrior screw_poses(std::int64_t step, int count, const PriorConfig& config = {}) {
  PosePrior prior(config);
  for (int i = 0; i < count; ++i) prior.add_pose(kFirst + i * step, screw(kFirst + i * step));
  return prior;
}

TEST(PosePrior, InterpolatesAtConstantVelocity) {
  const PosePrior prior = screw_poses(100 * kMs, 40);
  for (std::int64_t t = kFirst; t <= kFirst + 3900 * kMs; t += 13 * kMs) {
    const Prior found = prior.prior_at(t);
    EXPECT_EQ(found.reason, PriorReason::kInterpolated);
    ASSERT_TRUE(found.T_world_camera);
    expect_same(*found.T_world_camera, screw(t) * forward_camera());
  }
}

TEST(PosePrior, ExtrapolatesAtMostAHundredMillisecondsForwards) {
  const PosePrior prior = screw_poses(50 * kMs, 3);
  const std::int64_t last = kFirst + 100 * kMs;
  const Prior found = prior.prior_at(last + 100 * kMs);
  EXPECT_EQ(found.reason, PriorReason::kExtrapolated);
  expect_same(*found.T_world_camera, screw(last + 100 * kMs) * forward_camera());
  const Prior too_late = prior.prior_at(last + 101 * kMs);
  EXPECT_EQ(too_late.reason, PriorReason::kPoseTooOld);
  EXPECT_FALSE(too_late.T_world_camera);
  EXPECT_FALSE(too_late.T_odom_camera);
}

TEST(PosePrior, ExtrapolatesAtMostAHundredMillisecondsBackwards) {
  const PosePrior prior = screw_poses(50 * kMs, 3);
  const Prior found = prior.prior_at(kFirst - 40 * kMs);
  EXPECT_EQ(found.reason, PriorReason::kExtrapolated);
  expect_same(*found.T_world_camera, screw(kFirst - 40 * kMs) * forward_camera());
  EXPECT_EQ(prior.prior_at(kFirst - 101 * kMs).reason, PriorReason::kPoseTooNew);
}

TEST(PosePrior, HoldsASinglePoseBecauseItKnowsNoVelocity) {
  const PosePrior prior = screw_poses(50 * kMs, 1);
  EXPECT_EQ(prior.prior_at(kFirst).reason, PriorReason::kInterpolated);
  for (const std::int64_t offset : {-100 * kMs, 100 * kMs}) {
    const Prior found = prior.prior_at(kFirst + offset);
    EXPECT_EQ(found.reason, PriorReason::kHeld);
    expect_same(*found.T_world_camera, screw(kFirst) * forward_camera());
  }
}

TEST(PosePrior, DoesNotInterpolateOverALongGap) {
  PosePrior prior = screw_poses(50 * kMs, 3);  // until 100 ms
  for (const std::int64_t t : {500 * kMs, 550 * kMs}) prior.add_pose(kFirst + t, screw(kFirst + t));
  EXPECT_EQ(prior.prior_at(kFirst + 150 * kMs).reason, PriorReason::kExtrapolated);
  EXPECT_EQ(prior.prior_at(kFirst + 300 * kMs).reason, PriorReason::kPoseGap);
  const Prior before_second_part = prior.prior_at(kFirst + 450 * kMs);
  EXPECT_EQ(before_second_part.reason, PriorReason::kExtrapolated);
  expect_same(*before_second_part.T_world_camera, screw(kFirst + 450 * kMs) * forward_camera());
}

TEST(PosePrior, SaysThatNoPoseHasArrived) {
  PosePrior prior;
  prior.add_camera_to_body(kFirst, forward_camera());
  EXPECT_EQ(prior.prior_at(kFirst).reason, PriorReason::kNoPose);
  EXPECT_EQ(to_string(prior.prior_at(kFirst).reason), "no_pose");
}

TEST(PosePrior, AFrameWaitsForAPoseOfItsOwnTimeOrLater) {
  PosePrior prior;
  EXPECT_FALSE(prior.is_ready(kFirst));
  prior.note_input(kFirst);
  EXPECT_FALSE(prior.is_ready(kFirst));
  prior.add_pose(kFirst - 1, screw(kFirst - 1));
  EXPECT_FALSE(prior.is_ready(kFirst));
  prior.add_pose(kFirst, screw(kFirst));
  EXPECT_TRUE(prior.is_ready(kFirst));
}

TEST(PosePrior, AFrameWaitsNoLongerThanAHundredMillisecondsOfSensorTime) {
  PosePrior prior = screw_poses(50 * kMs, 1);
  const std::int64_t frame = kFirst + 20 * kMs;
  prior.note_input(frame);
  prior.note_input(frame + 99 * kMs);
  EXPECT_FALSE(prior.is_ready(frame));
  prior.note_input(frame + 66 * kMs);  // late: the clock does not go back
  prior.add_camera_to_body(frame + 100 * kMs, forward_camera());
  EXPECT_TRUE(prior.is_ready(frame));
}

TEST(PosePrior, NeverMovesAcrossAJump) {
  PosePrior prior = screw_poses(50 * kMs, 3);
  const Isometry3d jump(Eigen::Translation3d(0.0, 5.0, 0.0));
  for (const std::int64_t t : {150 * kMs, 200 * kMs}) {
    prior.add_pose(kFirst + t, jump * screw(kFirst + t));
  }
  EXPECT_EQ(prior.pose_counts().jumps, 1);
  const Prior before = prior.prior_at(kFirst + 120 * kMs);
  EXPECT_EQ(before.reason, PriorReason::kExtrapolated);
  expect_same(*before.T_world_camera, screw(kFirst + 120 * kMs) * forward_camera());
  const Prior after = prior.prior_at(kFirst + 140 * kMs);
  expect_same(*after.T_world_camera, jump * screw(kFirst + 140 * kMs) * forward_camera());
}

TEST(PosePrior, IgnoresAndCountsPosesOutOfOrder) {
  PosePrior prior = screw_poses(50 * kMs, 3);
  prior.add_pose(kFirst + 70 * kMs, Isometry3d::Identity());
  prior.add_pose(kFirst + 100 * kMs, Isometry3d::Identity());
  EXPECT_EQ(prior.pose_counts().out_of_order, 2);
  EXPECT_EQ(prior.pose_counts().received, 5);
  expect_same(*prior.prior_at(kFirst + 70 * kMs).T_world_camera,
              screw(kFirst + 70 * kMs) * forward_camera());
}

TEST(PosePrior, StartsAnewWhenALogIsPlayedAgain) {
  PosePrior prior = screw_poses(50 * kMs, 100);
  prior.note_input(kFirst + 4950 * kMs);
  prior.add_pose(kFirst, screw(kFirst));
  EXPECT_EQ(prior.pose_counts().restarts, 1);
  EXPECT_EQ(prior.prior_at(kFirst + 4000 * kMs).reason, PriorReason::kPoseTooOld);
  EXPECT_TRUE(prior.is_ready(kFirst + 4950 * kMs)) << "a frame of before must not wait for ever";
  prior.note_input(kFirst + 30 * kMs);
  EXPECT_FALSE(prior.is_ready(kFirst + 30 * kMs)) << "the clock has gone back with the inputs";
}

TEST(PosePrior, IgnoresAndCountsWhatIsNoPose) {
  PosePrior prior;
  Isometry3d broken = Isometry3d::Identity();
  broken.linear()(0, 0) = std::numeric_limits<double>::quiet_NaN();
  prior.add_pose(kFirst, broken);
  prior.add_pose(-1, Isometry3d::Identity());
  prior.add_pose(std::numeric_limits<std::int64_t>::max(), Isometry3d::Identity());
  EXPECT_EQ(prior.pose_counts().invalid, 3);
  EXPECT_EQ(prior.prior_at(kFirst).reason, PriorReason::kNoPose);
  EXPECT_FALSE(prior.is_ready(kFirst));
  EXPECT_THROW(prior.note_input(-1), std::invalid_argument);
  EXPECT_THROW(prior.prior_at(std::numeric_limits<std::int64_t>::min()), std::invalid_argument);
}

TEST(PosePrior, FollowsAMovingNeck) {
  PosePrior prior = screw_poses(50 * kMs, 5);
  const auto neck = [](double angle) {
    return Isometry3d(AngleAxisd(angle, Vector3d::UnitY())) * forward_camera();
  };
  prior.add_camera_to_body(kFirst, neck(0.0));
  prior.add_camera_to_body(kFirst + 80 * kMs, neck(0.4));
  expect_same(*prior.prior_at(kFirst + 20 * kMs).T_world_camera,
              screw(kFirst + 20 * kMs) * neck(0.1));
  expect_same(*prior.prior_at(kFirst + 190 * kMs).T_world_camera,
              screw(kFirst + 190 * kMs) * neck(0.4));
}

TEST(PosePrior, ANeckThatStandsStillNeedSaySoOnlyOnce) {
  PosePrior prior;
  const Isometry3d neck(Eigen::Translation3d(0.1, 0.2, 0.3));
  prior.add_camera_to_body(kFirst, neck);
  const std::int64_t much_later = kFirst + 3'600'000 * kMs;
  prior.add_pose(much_later, screw(kFirst));
  expect_same(*prior.prior_at(much_later).T_world_camera, screw(kFirst) * neck);
}

TEST(PosePrior, BeforeTheFirstNeckTheConfiguredCameraHolds) {
  PriorConfig config;
  config.camera_position = {0.1, 0.0, 1.2};
  PosePrior prior = screw_poses(50 * kMs, 10, config);
  const Isometry3d neck(Eigen::Translation3d(0.0, 0.0, 9.0));
  prior.add_camera_to_body(kFirst + 300 * kMs, neck);
  const Isometry3d configured = Eigen::Translation3d(0.1, 0.0, 1.2) * forward_camera();
  expect_same(*prior.prior_at(kFirst + 100 * kMs).T_world_camera,
              screw(kFirst + 100 * kMs) * configured);
  expect_same(*prior.prior_at(kFirst + 250 * kMs).T_world_camera, screw(kFirst + 250 * kMs) * neck);
}

TEST(PosePrior, OdometryIsCorrectedOnTheLeftAndLocalisationNotAtAll) {
  const Isometry3d T_world_odom =
      Eigen::Translation3d(3.0, -1.0, 0.0) * AngleAxisd(0.3, Vector3d::UnitZ());
  for (const std::string kind : {"odometry", "localisation"}) {
    PriorConfig config;
    config.kind = kind;
    PosePrior prior = screw_poses(50 * kMs, 2, config);
    prior.set_T_world_odom(T_world_odom);
    const Prior found = prior.prior_at(kFirst + 10 * kMs);
    const Isometry3d T_odom_camera = screw(kFirst + 10 * kMs) * forward_camera();
    expect_same(*found.T_odom_camera, T_odom_camera);
    expect_same(*found.T_world_camera,
                kind == "odometry" ? T_world_odom * T_odom_camera : T_odom_camera);
  }
}

TEST(PosePrior, TheBufferIsBoundedAndKeepsTheNewest) {
  const int count = static_cast<int>(PoseBuffer::kCapacity) + 100;
  const PosePrior prior = screw_poses(5 * kMs, count);
  const std::int64_t oldest_kept = kFirst + 100 * 5 * kMs;
  EXPECT_EQ(prior.prior_at(oldest_kept - 200 * kMs).reason, PriorReason::kPoseTooNew);
  EXPECT_EQ(prior.prior_at(oldest_kept).reason, PriorReason::kInterpolated);
  expect_same(*prior.prior_at(oldest_kept - 10 * kMs).T_world_camera,
              screw(oldest_kept - 10 * kMs) * forward_camera());
}

TEST(PosePrior, TheOldestPoseKeptIsHeldWhenTheNextIsFarAway) {
  PosePrior prior;
  const int capacity = static_cast<int>(PoseBuffer::kCapacity);
  prior.add_pose(kFirst, screw(kFirst));
  std::int64_t t = kFirst + 10 * kMs;
  prior.add_pose(t, screw(t));
  for (int i = 1; i < capacity; ++i) prior.add_pose(t + i * 200 * kMs, screw(kFirst));
  const Prior found = prior.prior_at(t + 50 * kMs);
  EXPECT_EQ(found.reason, PriorReason::kHeld);
  expect_same(*found.T_world_camera, screw(t) * forward_camera());
}

TEST(PosePrior, RefusesAConfigurationThatMakesNoSense) {
  PriorConfig config;
  config.kind = "gps";
  config.max_gap = 0.0;
  config.camera_position = {1.0, 2.0};
  config.camera_quaternion = {1.0, 1.0, 0.0, 0.0};
  EXPECT_EQ(config.validate().size(), 4U);
  EXPECT_THROW(PosePrior{config}, std::invalid_argument);
  PosePrior prior;
  Isometry3d scaled = Isometry3d::Identity();
  scaled.linear() *= 2.0;
  EXPECT_THROW(prior.set_T_world_odom(scaled), std::invalid_argument);
}

}  // namespace
}  // namespace geomap::perception
