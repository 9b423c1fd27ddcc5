// SPDX-License-Identifier: BSD-3-Clause
// geomap-kinect: frames of a Kinect-class camera.
#include <cstdio>

#include "drivers/kinect_process.hpp"
#include "drivers/openni2_camera.hpp"

namespace {

using namespace geomap::drivers;

struct Options {
  std::string device;
  std::string recording;
  bool lossless = false;
};

CameraSource source_of(const Options& options, const KinectConfig& config) {
  CameraSource source;
  source.is_recording = options.device.ends_with(".oni");
  source.keeps_sensor_time = source.is_recording && options.lossless;
  source.open = [options, config, is_recording = source.is_recording] {
    return is_recording ? play_openni2(options.device, options.lossless, config)
                        : open_openni2(options.device, options.recording, config);
  };
  return source;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace geomap;
  messaging::LiveOptions live_options;
  Options options;
  bool list = false;
  return messaging::run_program(
      argc, argv,
      {.name = "geomap-kinect",
       .description = "Publishes RGBD_FRAME from a Kinect-class camera or a recording of one.",
       .uses_lcm = true},
      [&](messaging::OptionParser& parser) {
        messaging::declare_live(parser, live_options);
        parser.option("--device", options.device,
                      "URI, see --list, or FILE.oni; empty: any camera");
        parser.option("--record", options.recording, "FILE.oni to write; empty: none");
        parser.flag("--list", list, "print cameras and their modes, nothing else");
      },
      [&](const messaging::CommonOptions& common) {
        if (list) {
          std::printf("%s", drivers::list_openni2().c_str());
          return 0;
        }
        options.lossless = live_options.lossless;
        const auto config = common.config.read<drivers::KinectConfig>("kinect");
        messaging::LiveProcess live("geomap-kinect", common, live_options);
        drivers::KinectProcess process(config, source_of(options, config), live);
        return live.run([] {}, [&] { return process.summary(); });
      });
}
