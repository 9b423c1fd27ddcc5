// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string>
#include <vector>

namespace geomap::drivers {

/// @brief Where a robot is at one moment, and where its head turns. Angles may go on beyond a full
/// turn: nothing is wrapped.
struct Waypoint {
  double time = 0.0;  // [s]
  double x = 0.0;     // of the base in the world [m]
  double y = 0.0;     // of the base in the world [m]
  double yaw = 0.0;   // of the base, from the world's x to its y [rad]
  double pan = 0.0;   // of the neck, to the left [rad]
  double tilt = 0.0;  // of the neck, downwards [rad]
};

/// @brief The way of a robot with its camera on a neck.
struct RobotTrajectory {
  std::string name;
  double camera_height = 1.2;   // of the neck's joint above the floor [m]
  double camera_forward = 0.1;  // of the camera's centre before the neck's joint [m]
  std::vector<Waypoint> waypoints;
};

struct RobotPose {
  Eigen::Isometry3d T_world_body;   // body on the floor: x forward, z up
  Eigen::Isometry3d T_body_camera;  // the camera's frame is optical
};

/// @brief A smooth movement through the way points.
///
/// Every coordinate is a monotone piecewise cubic of time: once continuously differentiable, never
/// beyond the two way points around it, at rest where a way point repeats the one before, and at
/// both ends. Fritsch, Butland, "A Method for Constructing Local Monotone Piecewise Cubic
/// Interpolants", SIAM J. Sci. Stat. Comput. 5 (1984). The same bits on every machine.
class CameraTrajectory {
 public:
  /// @throws std::invalid_argument without way points, with a number that is not finite, or when
  /// their times do not rise strictly from 0 or later.
  explicit CameraTrajectory(RobotTrajectory trajectory);

  /// @brief Base and neck at `time` [s]; the first way point before it, the last one after it.
  Waypoint waypoint_at(double time) const;

  RobotPose at(double time) const;

  /// @brief Time of the last way point [s].
  double duration() const { return trajectory_.waypoints.back().time; }
  const std::string& name() const { return trajectory_.name; }

 private:
  static constexpr std::array kCoordinates = {&Waypoint::x, &Waypoint::y, &Waypoint::yaw,
                                              &Waypoint::pan, &Waypoint::tilt};
  using Slopes = std::array<double, kCoordinates.size()>;  // [1/s] times the coordinate's unit

  RobotTrajectory trajectory_;
  std::vector<Slopes> slopes_;  // at each way point
};

}  // namespace geomap::drivers
