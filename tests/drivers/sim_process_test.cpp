// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/sim_process.hpp"

#include <cmath>
#include <lcm/lcm-cpp.hpp>

#include "drivers/data_set_writer.hpp"
#include "drivers/truth_file.hpp"
#include "messaging/convert_frame.hpp"
#include "messaging/convert_geometry.hpp"
#include "messaging/log_reader.hpp"
#include "messaging/safe_decode.hpp"

namespace geomap::drivers {
namespace {

// A wall 2 m ahead of a robot that drives along it for a second, turning its neck.
Scene wall() {
  Scene scene;
  scene.name = "wall";
  SceneFace face;
  face.corner = {2.0, 4.0, -1.0};
  face.u = {0.0, -8.0, 0.0};
  face.v = {0.0, 0.0, 4.0};
  scene.add_face("wall", {200, 100, 50}, face);
  return scene;
}

CameraTrajectory drive() {
  RobotTrajectory trajectory;
  trajectory.name = "drive";
  trajectory.waypoints = {{0.0, 0.0, -0.5, 0.0, 0.0, 0.0}, {1.0, 0.0, 0.5, 0.0, 0.3, 0.1}};
  return CameraTrajectory(trajectory);
}

struct Simulated {
  std::vector<geometry::RgbdFrame> frames;
  std::vector<Eigen::Isometry3d> T_world_camera;  // TRUTH_POSE
  std::vector<Eigen::Isometry3d> T_odom_body;     // POSE
  std::vector<Eigen::Isometry3d> T_body_camera;   // CAMERA_TO_BODY
};

template <class Message>
Message decoded(const messaging::LogEvent& event) {
  return *messaging::safe_decode<Message>(event.data.data(), event.data.size()).message;
}

Simulated read_log(const std::filesystem::path& file) {
  Simulated result;
  messaging::LogReader reader(file.string());
  while (const auto event = reader.next()) {
    if (event->channel == "RGBD_FRAME") {
      result.frames.push_back(*messaging::to_frame(decoded<geomap::rgbd_frame_t>(*event)).frame);
    } else if (event->channel == "POSE") {
      result.T_odom_body.push_back(messaging::from_message(decoded<bot_core::pose_t>(*event)));
    } else {
      auto& list = event->channel == "TRUTH_POSE" ? result.T_world_camera : result.T_body_camera;
      list.push_back(messaging::from_message(decoded<bot_core::rigid_transform_t>(*event)));
    }
  }
  return result;
}

class Simulation : public ::testing::Test {
 protected:
  SimulationSummary record(const std::string& name, const SimulationConfig& config = {},
                           const OdometryDriftConfig& drift = {}) {
    return SimProcess(scene_, drive(), config, drift).record(folder_ / name, [](std::size_t) {
      return true;
    });
  }

  const Scene scene_ = wall();
  testing::TemporaryFolder folder_;
};

TEST_F(Simulation, ALogHoldsWhatTheRobotWouldHaveSaid) {
  const SimulationSummary summary = record("a.lcmlog");
  EXPECT_EQ(summary.frames, 31U);
  const Simulated log = read_log(folder_ / "a.lcmlog");
  ASSERT_EQ(log.frames.size(), 31U);
  ASSERT_EQ(log.T_odom_body.size(), 31U);
  ASSERT_EQ(log.T_world_camera.size(), 31U);
  for (std::size_t i = 0; i < log.frames.size(); ++i) {
    const RobotPose pose = drive().at(static_cast<double>(i) / 30.0);
    EXPECT_LT((log.T_body_camera[i].matrix() - pose.T_body_camera.matrix()).norm(), 1e-12);
    const Eigen::Isometry3d expected = pose.T_world_body * pose.T_body_camera;
    EXPECT_LT((log.T_world_camera[i].matrix() - expected.matrix()).norm(), 1e-12);
    // Each reading, put into the world by the true pose, is on the wall.
    const geometry::RgbdFrame& frame = log.frames[i];
    const double z = 0.001 * frame.depth.at(100, 300);
    EXPECT_NEAR((expected * frame.depth_camera.point(100, 300, z)).x(), 2.0, 0.001);
  }
}

TEST_F(Simulation, TheOdometryIsExactAtFirstAndDriftsAsAskedFor) {
  OdometryDriftConfig drift;
  drift.drift_m_per_m = 0.1;
  drift.drift_deg_per_m = 0.0;
  record("a.lcmlog", {}, drift);
  const Simulated log = read_log(folder_ / "a.lcmlog");
  EXPECT_EQ(log.T_odom_body[0].translation(), Eigen::Vector3d(0.0, -0.5, 0.0));
  const Eigen::Vector3d end(0.0, 0.5, 0.0);
  EXPECT_NEAR((log.T_odom_body.back().translation() - end).norm(), 0.1, 1e-9);
}

TEST_F(Simulation, TheTruthIsBesideTheLog) {
  record("a.lcmlog");
  const Truth truth = read_truth(folder_ / "a.truth.yaml");
  ASSERT_EQ(truth.planes.size(), 1U);
  EXPECT_EQ(truth.planes[0].name, "wall");
  EXPECT_NEAR(truth.planes[0].area, 32.0, 1e-6);
  EXPECT_GT(truth.planes[0].visible_area, 3.0);
  EXPECT_LT(truth.planes[0].visible_area, 10.0);
}

TEST_F(Simulation, TheSameCommandGivesTheSameBytesAnotherSeedOthers) {
  SimulationConfig config;
  config.sensor.noise = SensorNoise::kKinect;
  record("a.lcmlog", config);
  record("b.lcmlog", config);
  config.seed = 2;
  record("c.lcmlog", config);
  const auto bytes = testing::file_bytes(folder_ / "a.lcmlog");
  EXPECT_EQ(testing::file_bytes(folder_ / "b.lcmlog"), bytes);
  EXPECT_NE(testing::file_bytes(folder_ / "c.lcmlog"), bytes);
}

TEST_F(Simulation, StoppedItLeavesNothingBehind) {
  const auto summary =
      SimProcess(scene_, drive(), {}, {}).record(folder_ / "a.lcmlog", [](std::size_t i) {
        return i < 5;
      });
  EXPECT_TRUE(summary.stopped);
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(Simulation, LiveFramesComeOnTheirChannelsAndLateOnesAreDroppedAndCounted) {
  lcm::LCM bus("memq://");
  int frames = 0, poses = 0;
  bus.subscribeFunction(
      "robot1/RGBD_FRAME",
      +[](const lcm::ReceiveBuffer*, const std::string&, int* count) { ++*count; }, &frames);
  bus.subscribeFunction(
      "robot1/POSE", +[](const lcm::ReceiveBuffer*, const std::string&, int* count) { ++*count; },
      &poses);
  SimulationConfig config;
  config.rate = 500.0;  // faster than any machine
  SimProcess process(scene_, drive(), config, {});
  const SimulationSummary summary =
      process.publish(bus, "robot1/", [](std::size_t) { return true; });
  while (bus.handleTimeout(0) > 0) {
  }
  EXPECT_EQ(static_cast<std::size_t>(frames), summary.frames);
  EXPECT_EQ(poses, frames);
  EXPECT_GT(summary.dropped, 0U);
  EXPECT_EQ(summary.frames + summary.dropped, process.size());
}

}  // namespace
}  // namespace geomap::drivers
