// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/trajectory_file.hpp"

#include <algorithm>
#include <filesystem>

#include "drivers/data_set_writer.hpp"
#include "drivers/frame_source.hpp"
#include "drivers/greatest_speed.hpp"
#include "geometry/angles.hpp"

namespace geomap::drivers {
namespace {

namespace fs = std::filesystem;
using geometry::radians;

class TrajectoryFile : public ::testing::Test {
 protected:
  RobotTrajectory read(const std::string& text) {
    testing::write_text(file_, text);
    return read_robot_trajectory(file_);
  }

  // What the error says after the file's name.
  std::string complaint(const std::string& text) {
    try {
      read(text);
    } catch (const SourceError& error) {
      const std::string what = error.what();
      EXPECT_TRUE(what.starts_with(file_.string() + ":")) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
      return what.substr(file_.string().size() + 1);
    }
    return "no error";
  }

  testing::TemporaryFolder folder_;
  const fs::path file_ = folder_ / "way.yaml";
};

TEST_F(TrajectoryFile, HoldsTheCameraAndTheWayPoints) {
  const RobotTrajectory way = read(
      "name: there and back\ncamera_height: 1.5\ncamera_forward: -0.2\nwaypoints:\n"
      "  - {t: 0.5, x: 1, y: -2, yaw_deg: 30, pan_deg: -20, tilt_deg: 10}\n");
  EXPECT_EQ(way.name, "there and back");
  EXPECT_EQ(way.camera_height, 1.5);
  EXPECT_EQ(way.camera_forward, -0.2);
  ASSERT_EQ(way.waypoints.size(), 1U);
  const Waypoint& point = way.waypoints.front();
  EXPECT_EQ(point.time, 0.5);
  EXPECT_EQ(point.x, 1.0);
  EXPECT_EQ(point.y, -2.0);
  EXPECT_EQ(point.yaw, radians(30.0));
  EXPECT_EQ(point.pan, radians(-20.0));
  EXPECT_EQ(point.tilt, radians(10.0));
}

TEST_F(TrajectoryFile, WhatIsNotGivenStaysAsItWas) {
  const RobotTrajectory way = read("waypoints: [{t: 0, y: 2}, {t: 1, yaw_deg: 400}, {t: 2, x: 1}]");
  EXPECT_EQ(way.name, "way");
  EXPECT_EQ(way.camera_height, RobotTrajectory{}.camera_height);
  const Waypoint& last = way.waypoints.back();
  EXPECT_EQ(last.x, 1.0);
  EXPECT_EQ(last.y, 2.0);
  EXPECT_EQ(last.yaw, radians(400.0));
  EXPECT_EQ(last.tilt, 0.0);
}

TEST_F(TrajectoryFile, ErrorsNameTheFileTheLineAndTheFault) {
  const std::string head = "camera_height: 1.2\nwaypoints:\n  - {t: 0, x: 1}\n";
  EXPECT_EQ(complaint(head + "  - {t: 1, yaw: 20}\n"),
            "4: unknown key 'yaw'; known here: t, x, y, yaw_deg, pan_deg, tilt_deg");
  EXPECT_EQ(
      complaint("camera_hight: 1\n" + head),
      "1: unknown key 'camera_hight'; known here: name, camera_height, camera_forward, waypoints");
  EXPECT_EQ(complaint(head + "  - {x: 1}\n"), "4: 't' is missing");
  EXPECT_EQ(complaint(head + "  - {t: 0, x: 1}\n"),
            "4: t must be more than that of the way point before");
  EXPECT_EQ(complaint("waypoints:\n  - {t: -1}\n"), "2: t must be 0 or more");
  EXPECT_EQ(complaint(head + "  - {t: 1, x: 1, x: 2}\n"), "4: 'x' is given twice");
  EXPECT_EQ(complaint(head + "  - {t: 1, x: far}\n"), "4: 'x' must be a number");
  EXPECT_EQ(complaint(head + "  - {t: .inf}\n"), "4: 't' must be a number");
  EXPECT_EQ(complaint(head + "  - {t: nan}\n"), "4: 't' must be a number");
  EXPECT_EQ(complaint(head + "  - {t: 1, x: [2]}\n"), "4: 'x' must be a number");
  EXPECT_EQ(complaint(head + "  - 7\n"), "4: expected KEY: VALUE pairs");
  EXPECT_EQ(complaint("waypoints: {t: 0}\n"), "1: 'waypoints' must be a list");
  EXPECT_EQ(complaint("name: nowhere\n"), "1: no way points");
  EXPECT_EQ(complaint(""), "1: expected KEY: VALUE pairs");
  EXPECT_THAT(complaint("name: x\nwaypoints: [{t: 0\n"), ::testing::HasSubstr(": not YAML: "));
}

TEST_F(TrajectoryFile, AFileThatIsMissingIsNamed) {
  EXPECT_THROW(read_robot_trajectory(folder_ / "none.yaml"), SourceError);
}

std::vector<fs::path> shipped_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(GEOMAP_SOURCE_DIR "/config/trajectories")) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(ShippedTrajectories, LoadUnderTheirNamesAndAreNoFasterThanARobot) {
  ASSERT_GE(shipped_files().size(), 2U);
  for (const fs::path& file : shipped_files()) {
    const CameraTrajectory trajectory(read_robot_trajectory(file));
    EXPECT_EQ(trajectory.name() + ".yaml", file.filename()) << file;
    const testing::Speed speed = testing::greatest_speed(trajectory);
    EXPECT_LE(speed.metres, 0.6) << file;
    EXPECT_LE(speed.degrees, 60.0) << file;
  }
}

TEST(ShippedTrajectories, TheSweepIsSlowAndTheTurnIsAWholeOne) {
  const fs::path folder = GEOMAP_SOURCE_DIR "/config/trajectories";
  const testing::Speed sweep =
      testing::greatest_speed(CameraTrajectory(read_robot_trajectory(folder / "sweep.yaml")));
  EXPECT_LE(sweep.metres, 0.3);
  EXPECT_LE(sweep.degrees, 25.0);
  const CameraTrajectory turn(read_robot_trajectory(folder / "turn360.yaml"));
  EXPECT_EQ(turn.duration(), 90.0);
  EXPECT_EQ(turn.waypoint_at(90.0).yaw - turn.waypoint_at(0.0).yaw, radians(360.0));
  EXPECT_EQ(testing::greatest_speed(turn).metres, 0.0);
}

}  // namespace
}  // namespace geomap::drivers
