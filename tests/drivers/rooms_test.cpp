// SPDX-License-Identifier: BSD-3-Clause
// The grid of rooms that scripts/make_rooms writes.
#include <cstdlib>

#include "drivers/data_set_writer.hpp"
#include "drivers/greatest_speed.hpp"
#include "drivers/ray_caster.hpp"
#include "drivers/scene_file.hpp"
#include "drivers/simulated_kinect.hpp"
#include "drivers/trajectory_file.hpp"

namespace geomap::drivers {
namespace {

constexpr int kSide = 6;
constexpr double kRoomSeconds = 26.0;

class Rooms : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string command = std::string(GEOMAP_SOURCE_DIR "/scripts/make_rooms --rooms ") +
                                std::to_string(kSide) + " -o " + folder_.path().string();
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
  }

  testing::TemporaryFolder folder_;
};

TEST_F(Rooms, AreDrivenThroughAtARobotsPace) {
  const CameraTrajectory way(read_robot_trajectory(folder_ / "rooms_way.yaml"));
  const testing::Speed speed = testing::greatest_speed(way);
  EXPECT_LE(speed.metres, 0.6);
  EXPECT_LE(speed.degrees, 60.0);
  EXPECT_EQ(way.duration(), (kSide * kSide - 1) * kRoomSeconds + 14.0);
}

TEST_F(Rooms, LookTheSameFromWithinAtTheSameTimeOfTheVisit) {
  const Scene scene = read_scene(folder_ / "rooms.yaml");
  const CameraTrajectory way(read_robot_trajectory(folder_ / "rooms_way.yaml"));
  const RayCaster caster(scene);
  constexpr double kMaxRange = 5.0;  // [m]
  SceneView first, other;
  const auto look = [&](double time, SceneView& view) {
    const RobotPose pose = way.at(time);
    caster.cast(simulated_kinect(), pose.T_world_body * pose.T_body_camera, view);
  };
  for (const double since_middle : {-5.0, -2.0, 0.0, 2.0, 5.0, 8.0, 11.0, 14.0, 17.0, 19.5}) {
    look(2 * kRoomSeconds + since_middle, first);
    for (const int room : {3, kSide + 2, kSide + 3, 2 * kSide + 2}) {
      look(room * kRoomSeconds + since_middle, other);
      std::size_t different = 0;  // but for rays along the edge of something
      for (std::size_t i = 0; i < first.depth.depth.size(); ++i) {
        const double a = first.depth.depth[i];
        const double b = other.depth.depth[i];
        different += std::min(a, b) < kMaxRange && std::abs(a - b) > 1e-3;
      }
      EXPECT_LT(different, 300U) << "room " << room << " at " << since_middle << " s";
    }
  }
}

}  // namespace
}  // namespace geomap::drivers
