// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/trajectory_file.hpp"

#include <yaml-cpp/yaml.h>

#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "drivers/frame_source.hpp"
#include "drivers/input_file.hpp"
#include "geometry/angles.hpp"

namespace geomap::drivers {
namespace {

using Reader = std::function<void(const YAML::Node&)>;
using Readers = std::map<std::string, Reader>;  // what to do with the value of each key

class TrajectoryReader {
 public:
  explicit TrajectoryReader(std::string file) : file_(std::move(file)) {}

  RobotTrajectory read(const std::string& text) {
    try {
      read_map(YAML::Load(text), "the file",
               {{"name", [&](const YAML::Node& node) { trajectory_.name = scalar(node); }},
                {"camera_height", into(trajectory_.camera_height)},
                {"camera_forward", into(trajectory_.camera_forward)},
                {"waypoints", [&](const YAML::Node& node) { read_waypoints(node); }}});
    } catch (const YAML::Exception& error) {
      fail(error.mark, "not YAML: " + error.msg);
    }
    if (trajectory_.waypoints.empty()) fail(YAML::Mark(), "no way points");
    return std::move(trajectory_);
  }

 private:
  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& what) const {
    const int line = mark.is_null() ? 1 : mark.line + 1;
    throw SourceError(file_ + ":" + std::to_string(line) + ": " + what);
  }

  void read_map(const YAML::Node& map, const std::string& where, const Readers& readers) {
    if (!map.IsMap()) fail(map.Mark(), where + " holds no KEY: VALUE");
    std::set<std::string> seen;
    for (const auto& entry : map) {
      const std::string key = scalar(entry.first);
      const auto reader = readers.find(key);
      if (reader == readers.end()) {
        std::string known;
        for (const auto& [name, read] : readers) known += (known.empty() ? "" : ", ") + name;
        fail(entry.first.Mark(), "unknown key '" + key + "'; known are " + known);
      }
      if (!seen.insert(key).second) fail(entry.first.Mark(), "'" + key + "' is given twice");
      reader->second(entry.second);
    }
  }

  void read_waypoints(const YAML::Node& list) {
    if (!list.IsSequence()) fail(list.Mark(), "waypoints must be a list");
    for (const YAML::Node& node : list) {
      const bool first = trajectory_.waypoints.empty();
      Waypoint point = first ? Waypoint{} : trajectory_.waypoints.back();
      const double time_before = point.time;
      read_map(node, "a way point",
               {{"t", into(point.time)},
                {"x", into(point.x)},
                {"y", into(point.y)},
                {"yaw_deg", degrees_into(point.yaw)},
                {"pan_deg", degrees_into(point.pan)},
                {"tilt_deg", degrees_into(point.tilt)}});
      if (!node["t"]) fail(node.Mark(), "a way point needs t");
      if (first && point.time < 0.0) fail(node.Mark(), "t must be 0 or more");
      if (!first && point.time <= time_before) {
        fail(node.Mark(), "t must be more than that of the way point before");
      }
      trajectory_.waypoints.push_back(point);
    }
  }

  Reader into(double& value) {
    return [this, &value](const YAML::Node& node) { value = number(node); };
  }
  Reader degrees_into(double& value) {
    return [this, &value](const YAML::Node& node) { value = geometry::radians(number(node)); };
  }

  std::string scalar(const YAML::Node& node) const {
    if (!node.IsScalar()) fail(node.Mark(), "a single value is wanted");
    return node.Scalar();
  }

  // Unlike yaml-cpp's own, whatever the locale.
  double number(const YAML::Node& node) const {
    const std::string text = scalar(node);
    double value = 0.0;
    const char* end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stopped != end || !std::isfinite(value)) {
      fail(node.Mark(), "'" + text + "' is not a finite number");
    }
    return value;
  }

  std::string file_;
  RobotTrajectory trajectory_;
};

}  // namespace

RobotTrajectory read_robot_trajectory(const std::filesystem::path& path) {
  const std::vector<std::uint8_t> bytes = read_bytes(path);
  RobotTrajectory trajectory =
      TrajectoryReader(path.string()).read(std::string(bytes.begin(), bytes.end()));
  if (trajectory.name.empty()) trajectory.name = path.stem().string();
  return trajectory;
}

}  // namespace geomap::drivers
