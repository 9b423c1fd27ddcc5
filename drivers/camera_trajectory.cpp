// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/camera_trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "drivers/camera_mount.hpp"
#include "drivers/portable_math.hpp"

namespace geomap::drivers {
namespace {

using Eigen::Vector3d;

Eigen::Isometry3d pose(const Eigen::Matrix3d& R, const Vector3d& t) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = R;
  T.translation() = t;
  return T;
}

void require(bool holds, const char* message) {
  if (!holds) throw std::invalid_argument(message);
}

// A weighted harmonic mean of the slopes on both sides, 0 where they differ in sign.
double slope_between(double time_before, double slope_before, double time_after,
                     double slope_after) {
  if (!(slope_before * slope_after > 0.0)) return 0.0;
  const double weight_before = 2.0 * time_after + time_before;
  const double weight_after = time_after + 2.0 * time_before;
  return (weight_before + weight_after) /
         (weight_before / slope_before + weight_after / slope_after);
}

}  // namespace

CameraTrajectory::CameraTrajectory(RobotTrajectory trajectory)
    : trajectory_(std::move(trajectory)) {
  const std::vector<Waypoint>& points = trajectory_.waypoints;
  require(!points.empty(), "a trajectory needs a way point");
  require(std::isfinite(trajectory_.camera_height) && std::isfinite(trajectory_.camera_forward),
          "the camera's place must be finite");
  for (std::size_t i = 0; i < points.size(); ++i) {
    require(std::isfinite(points[i].time) && points[i].time >= 0.0, "times must be 0 or more");
    require(i == 0 || points[i].time > points[i - 1].time, "times must rise");
    for (const auto coordinate : kCoordinates) {
      require(std::isfinite(points[i].*coordinate), "way points must be finite");
    }
  }

  slopes_.resize(points.size(), Slopes{});
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const double before = points[i].time - points[i - 1].time;
    const double after = points[i + 1].time - points[i].time;
    for (std::size_t k = 0; k < kCoordinates.size(); ++k) {
      const auto coordinate = kCoordinates[k];
      const double here = points[i].*coordinate;
      slopes_[i][k] = slope_between(before, (here - points[i - 1].*coordinate) / before, after,
                                    (points[i + 1].*coordinate - here) / after);
    }
  }
}

Waypoint CameraTrajectory::waypoint_at(double time) const {
  require(!std::isnan(time), "the time is not a number");
  const std::vector<Waypoint>& points = trajectory_.waypoints;
  const auto next = std::upper_bound(points.begin(), points.end(), time,
                                     [](double t, const Waypoint& p) { return t < p.time; });
  if (next == points.begin()) return points.front();
  if (next == points.end()) return points.back();
  const auto i = static_cast<std::size_t>(next - points.begin());
  const Waypoint& from = points[i - 1];
  const Waypoint& to = points[i];

  // Hermite's cubic of two values and two slopes.
  const double length = to.time - from.time;
  const double s = (time - from.time) / length;
  const double rest = 1.0 - s;
  Waypoint result;
  result.time = time;
  for (std::size_t k = 0; k < kCoordinates.size(); ++k) {
    const auto coordinate = kCoordinates[k];
    result.*coordinate = from.*coordinate +
                         s * s * (3.0 - 2.0 * s) * (to.*coordinate - from.*coordinate) +
                         length * s * rest * (rest * slopes_[i - 1][k] - s * slopes_[i][k]);
  }
  return result;
}

RobotPose CameraTrajectory::at(double time) const {
  const Waypoint now = waypoint_at(time);
  const Vector3d neck(0.0, 0.0, trajectory_.camera_height);
  const Vector3d forward(trajectory_.camera_forward, 0.0, 0.0);
  const Eigen::Matrix3d R_body_head = turned_about_z(now.pan) * turned_about_y(now.tilt);
  return {pose(turned_about_z(now.yaw), Vector3d(now.x, now.y, 0.0)),
          pose(R_body_head * forward_camera_mount().linear(), neck + R_body_head * forward)};
}

}  // namespace geomap::drivers
