// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/camera_trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "drivers/camera_mount.hpp"

namespace geomap::drivers {
namespace {

using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

// Uneven times, a rest between 4 s and 5.5 s, steep next to flat, more than a full turn.
RobotTrajectory some_way() {
  return {"some",
          1.3,
          0.2,
          {{1.0, -2.0, 1.5, 0.0, 0.1, 0.2},
           {2.5, -1.9, 0.2, 2.0, 0.4, 0.5},
           {4.0, -1.0, 0.1, 5.0, -0.3, 0.6},
           {5.5, -1.0, 0.1, 5.0, -0.3, 0.6},
           {7.0, -1.2, 0.0, 9.0, 0.0, 0.1},
           {9.0, -3.0, -2.0, 9.5, 0.5, 0.0}}};
}

std::vector<double> coordinates(const Waypoint& p) { return {p.x, p.y, p.yaw, p.pan, p.tilt}; }

// One robot at the origin whose head stands still.
RobotPose standing(double yaw, double pan, double tilt) {
  return CameraTrajectory({"", 1.3, 0.2, {{0.0, 0.0, 0.0, yaw, pan, tilt}}}).at(0.0);
}

TEST(CameraTrajectory, PassesThroughTheWayPoints) {
  const CameraTrajectory trajectory(some_way());
  for (const Waypoint& point : some_way().waypoints) {
    EXPECT_EQ(coordinates(trajectory.waypoint_at(point.time)), coordinates(point)) << point.time;
  }
  EXPECT_EQ(trajectory.duration(), 9.0);
  EXPECT_EQ(trajectory.name(), "some");
}

TEST(CameraTrajectory, StaysBetweenTheWayPointsAroundIt) {
  const CameraTrajectory trajectory(some_way());
  const std::vector<Waypoint> points = some_way().waypoints;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto from = coordinates(points[i - 1]);
    const auto to = coordinates(points[i]);
    auto last = from;
    for (double t = points[i - 1].time; t < points[i].time; t += 0.01) {
      const auto now = coordinates(trajectory.waypoint_at(t));
      for (std::size_t k = 0; k < now.size(); ++k) {
        // Monotone, which includes within.
        EXPECT_GE((now[k] - last[k]) * (to[k] - from[k]), -1e-15) << t;
        EXPECT_GE((to[k] - now[k]) * (to[k] - from[k]), -1e-15) << t;
      }
      last = now;
    }
  }
}

TEST(CameraTrajectory, HasNoJumpsOfSpeed) {
  const CameraTrajectory trajectory(some_way());
  constexpr double kStep = 1e-6;
  for (double t = 0.5; t < 9.5; t += 0.25) {  // all way points, and between them
    const auto before = coordinates(trajectory.waypoint_at(t - kStep));
    const auto here = coordinates(trajectory.waypoint_at(t));
    const auto after = coordinates(trajectory.waypoint_at(t + kStep));
    for (std::size_t k = 0; k < here.size(); ++k) {
      EXPECT_NEAR((after[k] - here[k]) / kStep, (here[k] - before[k]) / kStep, 1e-4) << t;
    }
  }
}

TEST(CameraTrajectory, AStraightWayAtOneSpeedIsKept) {
  const CameraTrajectory trajectory(
      {"", 1.2, 0.1, {{0.0}, {1.0, 0.3}, {2.0, 0.6}, {4.0, 1.2}, {5.0, 1.5}, {6.0, 1.8}}});
  for (double t = 1.0; t <= 5.0; t += 0.1) {
    EXPECT_NEAR(trajectory.waypoint_at(t).x, 0.3 * t, 1e-15);
  }
}

TEST(CameraTrajectory, RestsWhereAWayPointIsRepeatedAndBeyondBothEnds) {
  const CameraTrajectory trajectory(some_way());
  const std::vector<Waypoint> points = some_way().waypoints;
  for (double t = 4.0; t <= 5.5; t += 0.1) {
    EXPECT_EQ(coordinates(trajectory.waypoint_at(t)), coordinates(points[2])) << t;
  }
  for (const double t : {-1.0, 0.0, 1.0}) {
    EXPECT_EQ(coordinates(trajectory.waypoint_at(t)), coordinates(points.front())) << t;
  }
  EXPECT_EQ(coordinates(trajectory.waypoint_at(100.0)), coordinates(points.back()));
}

TEST(CameraTrajectory, TheBodyStandsOnTheFloorAndFacesItsYaw) {
  const CameraTrajectory trajectory({"", 1.3, 0.2, {{0.0, 3.0, -2.0, kPi / 6.0 + 2.0 * kPi}}});
  const Eigen::Isometry3d T_world_body = trajectory.at(0.0).T_world_body;
  EXPECT_EQ(T_world_body.translation(), Vector3d(3.0, -2.0, 0.0));
  const Vector3d forward(std::sqrt(0.75), 0.5, 0.0);
  EXPECT_LT((T_world_body.linear() * Vector3d::UnitX() - forward).norm(), 1e-15);
  EXPECT_LT((T_world_body.linear() * Vector3d::UnitZ() - Vector3d::UnitZ()).norm(), 1e-15);
}

TEST(CameraTrajectory, AHeadThatLooksAheadIsTheForwardMount) {
  const Eigen::Isometry3d T_body_camera = standing(1.0, 0.0, 0.0).T_body_camera;
  EXPECT_EQ(T_body_camera.linear(), forward_camera_mount().linear());
  EXPECT_EQ(T_body_camera.translation(), Vector3d(0.2, 0.0, 1.3));
}

TEST(CameraTrajectory, ATiltOfAQuarterTurnLooksDown) {
  const Eigen::Isometry3d T_body_camera = standing(0.0, 0.0, kPi / 2.0).T_body_camera;
  EXPECT_LT((T_body_camera.linear() * Vector3d::UnitZ() + Vector3d::UnitZ()).norm(), 1e-15);
  EXPECT_LT((T_body_camera.linear() * Vector3d::UnitY() + Vector3d::UnitX()).norm(), 1e-15);
  EXPECT_LT((T_body_camera.translation() - Vector3d(0.0, 0.0, 1.1)).norm(), 1e-15);
}

TEST(CameraTrajectory, APanOfAQuarterTurnLooksToTheLeftAndTheTiltFollowsIt) {
  const Eigen::Isometry3d T_body_camera = standing(0.0, kPi / 2.0, kPi / 6.0).T_body_camera;
  const Vector3d axis(0.0, std::sqrt(0.75), -0.5);
  EXPECT_LT((T_body_camera.linear() * Vector3d::UnitZ() - axis).norm(), 1e-15);
  EXPECT_LT((T_body_camera.linear() * Vector3d::UnitX() - Vector3d::UnitX()).norm(), 1e-15);
  EXPECT_LT((T_body_camera.translation() - Vector3d(0.2 * axis + 1.3 * Vector3d::UnitZ())).norm(),
            1e-15);
}

TEST(CameraTrajectory, PosesAreRotations) {
  const CameraTrajectory trajectory(some_way());
  for (double t = 0.0; t < 9.0; t += 0.37) {
    const RobotPose pose = trajectory.at(t);
    for (const Eigen::Isometry3d& T : {pose.T_world_body, pose.T_body_camera}) {
      EXPECT_LT((T.linear() * T.linear().transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-15);
      EXPECT_GT(T.linear().determinant(), 0.0);
    }
  }
}

TEST(CameraTrajectory, WhatCannotBeIsRefused) {
  const auto refused = [](auto change) {
    RobotTrajectory way = some_way();
    change(way);
    EXPECT_THROW(CameraTrajectory{way}, std::invalid_argument);
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  refused([](RobotTrajectory& way) { way.waypoints.clear(); });
  refused([](RobotTrajectory& way) { way.waypoints[0].time = -1.0; });
  refused([](RobotTrajectory& way) { way.waypoints[2].time = way.waypoints[1].time; });
  refused([](RobotTrajectory& way) { way.waypoints[5].time = kNan; });
  refused([](RobotTrajectory& way) { way.waypoints[3].tilt = kNan; });
  refused([](RobotTrajectory& way) { way.camera_height = kNan; });
  EXPECT_THROW(CameraTrajectory(some_way()).at(kNan), std::invalid_argument);
}

}  // namespace
}  // namespace geomap::drivers
