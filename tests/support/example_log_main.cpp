// SPDX-License-Identifier: BSD-3-Clause
// geomap-example-log: two seconds in a room of four rectangles, as a log, where no recording is at
// hand.
#include <cstdio>
#include <string>

#include "drivers/camera_mount.hpp"
#include "messaging/channels.hpp"
#include "messaging/convert_frame.hpp"
#include "messaging/convert_geometry.hpp"
#include "messaging/log_writer.hpp"
#include "messaging/program.hpp"
#include "support/plane_renderer.hpp"

namespace {

using namespace geomap;

constexpr std::int64_t kStart = 1'000'000'000'000'000;  // [us]

struct Options {
  std::string out;
  int frames = 60;
  double sigma = 0.004;  // [m]
};

/// From the right of the table to the left of it, turning to keep it in view. `way` runs from 0
/// to 1.
Eigen::Isometry3d camera_on_its_way(double way) {
  const Eigen::Vector3d eye(0.9 - 1.4 * way, -1.5 + 0.3 * way * (1.0 - way), 1.3 + 0.2 * way);
  return testing::look_at(eye, {0.1 - 0.5 * way, 1.2, 0.6});
}

/// The channels that geomap-import writes, with the truth as the prior.
void write_frame(messaging::LogWriter& log, geometry::RgbdFrame frame, std::int64_t number,
                 const Eigen::Isometry3d& T_world_camera) {
  namespace channels = messaging::channels;
  const Eigen::Isometry3d T_body_camera = drivers::forward_camera_mount();
  const Eigen::Isometry3d T_world_body = T_world_camera * T_body_camera.inverse();
  const std::int64_t utime = kStart + (number * 1'000'000 + 15) / 30;
  frame.utime = utime;
  frame.sequence = number;
  frame.sensor = "example";
  log.write(channels::kCameraToBody, utime, messaging::to_rigid_transform(utime, T_body_camera));
  log.write(channels::kTruthPose, utime, messaging::to_rigid_transform(utime, T_world_camera));
  log.write(channels::kPose, utime, messaging::to_pose(utime, T_world_body));
  log.write(channels::kRgbdFrame, utime, messaging::to_message(frame));
}

int run(const Options& options) {
  if (options.frames < 2) throw messaging::ConfigError("--frames must be at least 2");
  if (!(options.sigma >= 0.0)) throw messaging::ConfigError("--sigma must be at least 0");
  messaging::LogWriter log(options.out);
  const auto scene = testing::small_room();
  for (int i = 0; i < options.frames; ++i) {
    const Eigen::Isometry3d T_world_camera =
        camera_on_its_way(static_cast<double>(i) / (options.frames - 1));
    const auto seed = static_cast<std::uint32_t>(i + 1);
    const auto rendering =
        testing::render(scene, testing::kinect_camera(), T_world_camera, options.sigma, seed);
    write_frame(log, rendering.frame, i, T_world_camera);
  }
  log.close();
  std::printf("%s: %d frames\n", options.out.c_str(), options.frames);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  return messaging::run_program(
      argc, argv,
      {.name = "geomap-example-log",
       .description = "Renders a small room with exact geometry and writes it as an LCM log.",
       .uses_config = false},
      [&](messaging::OptionParser& parser) {
        parser.positional("OUT", options.out, "log to write");
        parser.option("--frames", options.frames, "number of frames, at 30 Hz");
        parser.option("--sigma", options.sigma, "white noise of depth [m]");
      },
      [&](const messaging::CommonOptions&) { return run(options); });
}
