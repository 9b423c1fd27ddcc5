// SPDX-License-Identifier: BSD-3-Clause
// geomap-kinect: frames of a Kinect-class camera.
#include <cstdio>

#include "drivers/kinect_process.hpp"
#include "drivers/openni2_camera.hpp"

int main(int argc, char** argv) {
  using namespace geomap;
  messaging::LiveOptions options;
  drivers::OpenNi2Options camera;
  bool list = false;
  return messaging::run_program(
      argc, argv,
      {.name = "geomap-kinect",
       .description = "Publishes RGBD_FRAME from a Kinect-class camera or a recording of one.",
       .uses_lcm = true},
      [&](messaging::OptionParser& parser) {
        messaging::declare_live(parser, options);
        parser.option("--device", camera.device, "URI, see --list, or FILE.oni; empty: any camera");
        parser.option("--record", camera.recording, "FILE.oni to write; empty: none");
        parser.flag("--list", list, "print cameras and their modes, nothing else");
      },
      [&](const messaging::CommonOptions& common) {
        if (list) {
          std::printf("%s", drivers::list_openni2().c_str());
          return 0;
        }
        const auto config = common.config.read<drivers::KinectConfig>("kinect");
        camera.lossless = options.lossless;
        messaging::LiveProcess live("geomap-kinect", common, options);
        drivers::KinectProcess process(
            config, camera.device.ends_with(".oni") && options.lossless,
            [&] { return drivers::open_openni2(camera, config); }, live);
        return live.run([] {}, [&] { return process.summary(); });
      });
}
