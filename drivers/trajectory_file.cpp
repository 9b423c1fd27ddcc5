// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/trajectory_file.hpp"

#include "drivers/yaml_map.hpp"
#include "geometry/angles.hpp"

namespace geomap::drivers {
namespace {

// What is missing carries over from the way point before.
Waypoint waypoint_of(const YamlMap& map, const Waypoint& before) {
  map.allow_only({"t", "x", "y", "yaw_deg", "pan_deg", "tilt_deg"});
  const auto angle = [&map](const char* key, double fallback) {
    return map.has(key) ? geometry::radians(map.number(key)) : fallback;
  };
  Waypoint point;
  point.time = map.number("t");
  point.x = map.number("x", before.x);
  point.y = map.number("y", before.y);
  point.yaw = angle("yaw_deg", before.yaw);
  point.pan = angle("pan_deg", before.pan);
  point.tilt = angle("tilt_deg", before.tilt);
  return point;
}

}  // namespace

RobotTrajectory read_robot_trajectory(const std::filesystem::path& path) {
  const YamlMap root = YamlMap::load(path);
  root.allow_only({"name", "camera_height", "camera_forward", "waypoints"});
  RobotTrajectory trajectory;
  trajectory.name = root.text("name", path.stem().string());
  trajectory.camera_height = root.number("camera_height", trajectory.camera_height);
  trajectory.camera_forward = root.number("camera_forward", trajectory.camera_forward);
  for (const YamlMap& map : root.maps("waypoints")) {
    const bool first = trajectory.waypoints.empty();
    const Waypoint before = first ? Waypoint{} : trajectory.waypoints.back();
    trajectory.waypoints.push_back(waypoint_of(map, before));
    const double time = trajectory.waypoints.back().time;
    if (first && time < 0.0) map.fail("t must be 0 or more");
    if (!first && time <= before.time) map.fail("t must be more than that of the way point before");
  }
  if (trajectory.waypoints.empty()) root.fail("no way points");
  return trajectory;
}

}  // namespace geomap::drivers
