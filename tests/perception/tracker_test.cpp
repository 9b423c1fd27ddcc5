// SPDX-License-Identifier: BSD-3-Clause
#include "perception/tracker.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "geometry/angles.hpp"
#include "perception/rigid_transform.hpp"
#include "support/plane_renderer.hpp"

namespace geomap::perception {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr std::int64_t kDriveStart = 1'000'000'000;
constexpr std::int64_t kFrame = 33'333;

// A camera that goes along the room, 4 cm and about 1.5 degrees a frame.
Isometry3d truth(int i) {
  return testing::look_at({-0.9 + 0.04 * i, -1.3, 1.4}, {-0.7 + 0.01 * i, 0.9, 0.6});
}

geometry::RgbdFrame frame_at(const Isometry3d& T_world_camera, std::int64_t utime) {
  geometry::RgbdFrame frame =
      testing::render(testing::small_room(), testing::kinect_camera(2), T_world_camera, 0.003, 7)
          .frame;
  frame.utime = utime;
  return frame;
}

Isometry3d mount() {
  Isometry3d T_body_camera = Isometry3d::Identity();
  T_body_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return T_body_camera;
}

// Drives a tracker frame by frame.
class Drive {
 public:
  explicit Drive(const TrackerConfig& config = {}) : tracker_(config) {}

  Tracker& tracker() { return tracker_; }

  // @param odometry T_odom_camera, where there is any.
  Tracked see(int i, const geometry::RgbdFrame& frame,
              const std::optional<Isometry3d>& odometry = std::nullopt) {
    const std::int64_t utime = kDriveStart + i * kFrame;
    if (odometry) tracker_.prior().add_pose(utime, *odometry * mount().inverse());
    tracker_.prior().note_input(utime);
    return tracker_.track(utime, [&] { return &frame; });
  }
  Tracked see(int i, const std::optional<Isometry3d>& odometry = std::nullopt) {
    return see(i, frame_at(truth(i), kDriveStart + i * kFrame), odometry);
  }

 private:
  Tracker tracker_;
};

void expect_near(const Isometry3d& a, const Isometry3d& b, double metres, double radians) {
  EXPECT_LT((a.translation() - b.translation()).norm(), metres);
  EXPECT_LT(angle_between(a, b), radians);
}

geometry::RgbdFrame blind_frame() {
  geometry::RgbdFrame frame = frame_at(truth(0), kDriveStart);
  std::fill(frame.depth.millimetres.begin(), frame.depth.millimetres.end(),
            geometry::DepthImage::kInvalid);
  return frame;
}

TEST(Tracker, CorrectsAnOdometryThatDrifts) {
  Drive drive;
  Isometry3d drift = Isometry3d::Identity();
  int keyframes = 0;
  for (int i = 0; i < 30; ++i) {
    const Tracked tracked = drive.see(i, truth(0) * drift * truth(0).inverse() * truth(i));
    ASSERT_TRUE(tracked.T_world_camera) << tracked.reason;
    keyframes += tracked.status == TrackStatus::kKeyframe;
    if (tracked.status == TrackStatus::kKeyframe) {
      expect_near(*tracked.T_world_camera, truth(i), 0.01, 0.005);
    }
    drift = drift * Eigen::Translation3d(0.003, 0.002, 0.0) *
            Eigen::AngleAxisd(0.002, Vector3d::UnitY());
  }
  EXPECT_GE(keyframes, 8);
  // What the odometry has drifted by is now in T_world_odom.
  EXPECT_GT(drive.tracker().prior().T_world_odom().translation().norm(), 0.03);
  EXPECT_EQ(drive.tracker().point_map().keyframes(), static_cast<std::size_t>(keyframes));
}

// Two walls at right angles, far enough apart that a view of one shows nothing of the other.
geometry::RgbdFrame two_walls_seen_from(const Isometry3d& T_world_camera, std::int64_t utime) {
  const std::vector<testing::Rectangle> walls = {
      {"first", {2.0, 0.0, 1.0}, -Vector3d::UnitY(), Vector3d::UnitZ(), 0.3, 1.0, {}, {}},
      {"second", {2.0, 2.2, 1.0}, -Vector3d::UnitY(), Vector3d::UnitZ(), 0.4, 1.0, {}, {}}};
  geometry::RgbdFrame frame =
      testing::render(walls, testing::kinect_camera(2), T_world_camera, 0.003, 7).frame;
  frame.utime = utime;
  return frame;
}

Isometry3d turned_left(double degrees) {
  const double angle = geometry::radians(degrees);
  return testing::look_at({0.0, 0.0, 1.0}, {std::cos(angle), std::sin(angle), 1.0});
}

// Sees the first wall, then what is `degrees` to its left.
Tracked see_new_ground(double degrees, bool has_odometry) {
  Drive drive;
  drive.see(0, two_walls_seen_from(turned_left(0.0), kDriveStart), turned_left(0.0));
  const std::int64_t next = has_odometry ? 1 : 10;  // a pose held for so long says nothing
  const Isometry3d T_next = turned_left(degrees);
  return drive.see(static_cast<int>(next), two_walls_seen_from(T_next, kDriveStart + next * kFrame),
                   has_odometry ? std::optional(T_next) : std::nullopt);
}

TEST(Tracker, FollowsOdometryIntoWhatTheMapDoesNotKnow) {
  TrackerConfig config;
  config.registration.unknown_turn_deg = 60.0;
  Drive drive(config);
  drive.see(0, two_walls_seen_from(turned_left(0.0), kDriveStart), turned_left(0.0));
  const Isometry3d T_next = turned_left(40.0);
  const Tracked tracked = drive.see(1, two_walls_seen_from(T_next, kDriveStart + kFrame), T_next);
  ASSERT_EQ(tracked.status, TrackStatus::kKeyframe) << tracked.reason;
  EXPECT_EQ(tracked.registration->reason, RegistrationReason::kUnknownView);
  expect_near(*tracked.T_world_camera, T_next, 1e-9, 1e-9);
  EXPECT_EQ(drive.tracker().point_map().keyframes(), 2U);
}

TEST(Tracker, DoesNotFollowItFarOrWithoutIt) {
  const Tracked far = see_new_ground(40.0, true);  // 30 degrees are allowed
  EXPECT_EQ(far.status, TrackStatus::kRejected);
  EXPECT_EQ(far.reason, "overlap_too_small");
  EXPECT_NE(see_new_ground(25.0, false).status, TrackStatus::kKeyframe);
}

TEST(Tracker, GoesOnAtConstantVelocityWithoutOdometry) {
  Drive drive;
  int keyframes = 0;
  for (int i = 0; i < 25; ++i) {
    const Tracked tracked =
        i == 0 ? drive.see(i, truth(0)) : drive.see(i);  // one pose, which fixes the world
    ASSERT_TRUE(tracked.T_world_camera) << i << " " << tracked.reason;
    expect_near(*tracked.T_world_camera, truth(i), 0.01, 0.006);
    keyframes += tracked.status == TrackStatus::kKeyframe;
  }
  EXPECT_GE(keyframes, 6);
  EXPECT_LE(keyframes, 12);
}

TEST(Tracker, StartsAtTheConfiguredCameraWhenThereWasNeverAPose) {
  Drive drive;
  const Tracked first = drive.see(0);
  ASSERT_EQ(first.status, TrackStatus::kKeyframe);
  expect_near(*first.T_world_camera, mount(), 1e-9, 1e-9);
}

TEST(Tracker, TiesOdometryThatComesLateToTheWay) {
  Drive drive;
  for (int i = 0; i < 8; ++i) drive.see(i);
  // The odometry's frame has nothing to do with the world's.
  const Isometry3d T_odom_world =
      Eigen::Translation3d(5, 6, 7) * Isometry3d(Eigen::AngleAxisd(1.0, Vector3d::UnitZ()));
  Tracked tracked;
  for (int i = 8; i < 20; ++i) {
    tracked = drive.see(i, T_odom_world * truth(i));
    ASSERT_TRUE(tracked.T_world_camera) << tracked.reason;
  }
  EXPECT_EQ(drive.tracker().counts().relinked, 1);
  expect_near(*tracked.T_world_camera, mount() * truth(0).inverse() * truth(19), 0.015, 0.01);
}

TEST(Tracker, DoesNotFollowAJumpOfTheOdometry) {
  Drive drive;
  for (int i = 0; i < 10; ++i) drive.see(i, truth(i));
  const Isometry3d jump(Eigen::Translation3d(2.0, 0.0, 0.0));
  for (int i = 10; i < 20; ++i) {
    const Tracked tracked = drive.see(i, jump * truth(i));
    ASSERT_TRUE(tracked.T_world_camera) << tracked.reason;
    expect_near(*tracked.T_world_camera, truth(i), 0.015, 0.01);
  }
  EXPECT_EQ(drive.tracker().prior().pose_counts().jumps, 1);
  EXPECT_EQ(drive.tracker().counts().relinked, 1);
}

TEST(Tracker, ARejectedFrameChangesNothingAndTheNextIsTried) {
  Drive drive;
  for (int i = 0; i < 10; ++i) drive.see(i, truth(i));
  const std::size_t points = drive.tracker().point_map().size();
  const std::size_t keyframes = drive.tracker().point_map().keyframes();
  // A flat wall where the room should be.
  geometry::RgbdFrame wall = frame_at(truth(12), kDriveStart);
  std::fill(wall.depth.millimetres.begin(), wall.depth.millimetres.end(), std::uint16_t{3500});
  const Tracked rejected = drive.see(13, wall, truth(13));
  EXPECT_EQ(rejected.status, TrackStatus::kRejected);
  EXPECT_FALSE(rejected.reason.empty());
  EXPECT_EQ(drive.tracker().point_map().size(), points);
  EXPECT_EQ(drive.tracker().point_map().keyframes(), keyframes);
  const Tracked next = drive.see(14, truth(14));
  EXPECT_EQ(next.status, TrackStatus::kKeyframe) << next.reason;
}

TEST(Tracker, ABlindCameraOnOdometryIsNotLost) {
  Drive drive;
  for (int i = 0; i < 6; ++i) drive.see(i, truth(i));
  for (int i = 10; i < 40; ++i) {
    const Tracked tracked = drive.see(i, blind_frame(), truth(i));
    ASSERT_EQ(tracked.status, TrackStatus::kRejected);
    EXPECT_EQ(tracked.reason, "too_few_readings");
    expect_near(*tracked.T_world_camera, truth(i), 0.01, 0.01);
  }
  EXPECT_EQ(drive.tracker().counts().lost, 0);
}

TEST(Tracker, AViewThatLeavesADirectionOpenIsFollowedForAWhileWithoutEnteringTheMap) {
  TrackerConfig config;
  config.registration.lost_after = 5;
  geometry::RgbdFrame wall = frame_at(truth(0), kDriveStart);
  std::fill(wall.depth.millimetres.begin(), wall.depth.millimetres.end(), std::uint16_t{2000});
  Drive before_a_wall(config);
  ASSERT_EQ(before_a_wall.see(0, wall, truth(0)).status, TrackStatus::kKeyframe);
  for (int i = 1; i < 10; ++i) {
    const Tracked tracked = before_a_wall.see(i, wall);
    EXPECT_EQ(tracked.status, i < 5 ? TrackStatus::kRejected : TrackStatus::kLost) << i;
    if (i >= 5) continue;
    EXPECT_EQ(tracked.reason, "underconstrained");
    expect_near(*tracked.T_world_camera, truth(0), 0.002, 0.002);
  }
  EXPECT_EQ(before_a_wall.tracker().point_map().keyframes(), 1u);
}

TEST(Tracker, ALostCameraIsFoundWhenItSeesTheMapAgain) {
  TrackerConfig config;
  config.registration.lost_after = 5;
  Drive drive(config);
  drive.see(0, truth(0));
  for (int i = 1; i < 15; ++i) drive.see(i);
  const std::size_t points = drive.tracker().point_map().size();
  for (int i = 15; i < 30; ++i) {
    const Tracked tracked = drive.see(i, blind_frame());
    EXPECT_NE(tracked.status, TrackStatus::kKeyframe);
  }
  EXPECT_TRUE(drive.tracker().is_lost());
  EXPECT_EQ(drive.tracker().counts().lost, 1);
  EXPECT_EQ(drive.tracker().point_map().size(), points);  // mapping pauses
  // It is back where it began, far from where it was lost.
  Tracked tracked;
  int tries = 0;
  do {
    tracked = drive.see(30 + tries, frame_at(truth(2), kDriveStart));
  } while (drive.tracker().is_lost() && ++tries < 10);
  ASSERT_FALSE(drive.tracker().is_lost());
  EXPECT_EQ(drive.tracker().counts().relocalised, 1);
  expect_near(*tracked.T_world_camera, truth(2), 0.015, 0.01);
}

TEST(Tracker, ALostCameraIsNotFoundWhereItNeverWas) {
  TrackerConfig config;
  config.registration.lost_after = 3;
  Drive drive(config);
  drive.see(0, truth(0));
  for (int i = 1; i < 10; ++i) drive.see(i);
  const auto elsewhere = testing::render({{"sphere-like corner",
                                           {0, 0, 1},
                                           Vector3d(1, 1, 0).normalized(),
                                           Vector3d::UnitZ(),
                                           3,
                                           2,
                                           {90, 90, 90},
                                           {}},
                                          {"ramp",
                                           {0, 0.5, 0.2},
                                           Vector3d::UnitX(),
                                           Vector3d(0, 1, 0.6).normalized(),
                                           2,
                                           1,
                                           {90, 90, 90},
                                           {}}},
                                         testing::kinect_camera(2),
                                         testing::look_at({1.5, -1.8, 1.3}, {0.4, 0.2, 0.7}));
  for (int i = 10; i < 40; ++i) {
    EXPECT_NE(drive.see(i, elsewhere.frame).status, TrackStatus::kKeyframe);
  }
  EXPECT_TRUE(drive.tracker().is_lost());
  EXPECT_EQ(drive.tracker().counts().relocalised, 0);
}

TEST(Tracker, SurvivesPosesAndImagesThatMakeNoSense) {
  Drive drive;
  for (int i = 0; i < 6; ++i) drive.see(i, truth(i));
  Isometry3d nan = truth(8);
  nan.translation().x() = std::numeric_limits<double>::quiet_NaN();
  Isometry3d huge = truth(9);
  huge.translation().x() = 1e300;
  drive.see(8, nan);
  drive.see(9, huge);
  EXPECT_EQ(drive.tracker().prior().pose_counts().invalid, 1);
  const Tracked empty = drive.see(12, geometry::RgbdFrame{}, truth(12));
  EXPECT_EQ(empty.reason, "invalid_image");
  const Tracked none = drive.tracker().track(kDriveStart + 13 * kFrame, [] { return nullptr; });
  EXPECT_EQ(none.status, TrackStatus::kNoImage);
  Tracked good;
  for (int i = 14; i < 20; ++i) good = drive.see(i, truth(i));
  ASSERT_TRUE(good.T_world_camera);
  expect_near(*good.T_world_camera, truth(19), 0.02, 0.01);
}

TEST(Tracker, APoseTenSecondsLateIsCountedAndSurvived) {
  Drive drive;
  for (int i = 0; i < 10; ++i) drive.see(i, truth(i));
  drive.tracker().prior().add_pose(kDriveStart - 10'000'000, truth(0) * mount().inverse());
  for (int i = 10; i < 20; ++i) {
    const Tracked tracked = drive.see(i, truth(i));
    ASSERT_TRUE(tracked.T_world_camera) << tracked.reason;
    expect_near(*tracked.T_world_camera, truth(i), 0.015, 0.01);
  }
  EXPECT_GE(drive.tracker().prior().pose_counts().restarts, 1);
}

TEST(Tracker, TimeThatGoesBackIsCountedAndSurvived) {
  Drive drive;
  for (int i = 0; i < 10; ++i) drive.see(i, truth(i));
  drive.see(7, truth(7));
  EXPECT_EQ(drive.tracker().counts().time_went_back, 1);
  EXPECT_EQ(drive.see(11, truth(11)).reason, "");
}

TEST(Tracker, ARemovedKeyframeIsGoneFromTheMapAndFromTheSearch) {
  Drive drive;
  for (int i = 0; i < 12; ++i) drive.see(i, truth(i));
  const std::size_t keyframes = drive.tracker().point_map().keyframes();
  ASSERT_GE(keyframes, 3u);
  EXPECT_TRUE(drive.tracker().remove(kDriveStart));
  EXPECT_FALSE(drive.tracker().remove(kDriveStart));
  EXPECT_EQ(drive.tracker().point_map().keyframes(), keyframes - 1);
  EXPECT_TRUE(drive.see(13, truth(13)).T_world_camera);
}

TEST(Tracker, ALostCameraWhoseMapWasTakenAwayBeginsAnew) {
  TrackerConfig config;
  config.registration.lost_after = 2;
  Drive drive(config);
  drive.see(0, truth(0));
  for (int i = 1; i < 6; ++i) drive.see(i, blind_frame());
  ASSERT_TRUE(drive.tracker().is_lost());
  ASSERT_TRUE(drive.tracker().remove(kDriveStart));
  ASSERT_EQ(drive.tracker().point_map().keyframes(), 0u);
  drive.see(20, truth(20));
  EXPECT_FALSE(drive.tracker().is_lost());
  EXPECT_EQ(drive.tracker().point_map().keyframes(), 1u);
}

TEST(Tracker, TheMethodPriorTakesPosesAsTheyCome) {
  TrackerConfig config;
  config.registration.method = "prior";
  Drive drive(config);
  const Isometry3d off = truth(5) * Eigen::Translation3d(0.2, 0.0, 0.0);
  drive.see(0, truth(0));
  const Tracked tracked = drive.see(5, off);
  ASSERT_EQ(tracked.status, TrackStatus::kKeyframe);
  expect_near(*tracked.T_world_camera, off, 1e-9, 1e-9);
  EXPECT_EQ(drive.see(20).reason, "pose_too_old");
}

TEST(Tracker, RefusesSettingsThatMakeNoSense) {
  for (const auto& spoil : std::vector<std::function<void(TrackerConfig&)>>{
           [](TrackerConfig& c) { c.registration.method = "magic"; },
           [](TrackerConfig& c) { c.registration.lost_after = 0; },
           [](TrackerConfig& c) { c.registration.icp.icp.gate = -1.0; },
           [](TrackerConfig& c) { c.registration.icp.min_overlap = 2.0; },
           [](TrackerConfig& c) { c.depth_correction.sigma = 0.0; },
           [](TrackerConfig& c) { c.registration.found_overlap = std::nan(""); }}) {
    TrackerConfig config;
    spoil(config);
    EXPECT_THROW(Tracker{config}, std::invalid_argument);
  }
}

}  // namespace
}  // namespace geomap::perception
