// SPDX-License-Identifier: BSD-3-Clause
// geomap-kinect: frames of a Kinect-class camera.
#include <cmath>
#include <cstdio>
#include <optional>

#include "drivers/camera_drivers.hpp"
#include "drivers/kinect_process.hpp"
#include "geometry/angles.hpp"

int main(int argc, char** argv) {
  using namespace geomap;
  messaging::LiveOptions live_options;
  drivers::CameraOptions camera;
  std::optional<double> tilt_deg;
  std::string camera_file;
  bool list = false;
  return messaging::run_program(
      argc, argv,
      {.name = "geomap-kinect",
       .description = "Publishes RGBD_FRAME from a Kinect-class camera or a recording of one.",
       .uses_lcm = true},
      [&](messaging::OptionParser& parser) {
        messaging::declare_live(parser, live_options);
        parser.choice("--driver", camera.driver, {"openni2", "freenect"},
                      "openni2: PrimeSense, Xtion; freenect: Kinect v1; else both are tried");
        parser.option("--device", camera.device, "see --list, or FILE.oni; empty: any camera");
        parser.option("--record", camera.recording, "FILE.oni to write; empty: none");
        parser.option("--camera", camera_file,
                      "camera file (config/cameras): intrinsics, depth correction");
        parser.option("--tilt", tilt_deg, "of a Kinect's motor, -27 to 27 degrees upwards");
        parser.flag("--list", list, "print cameras and their modes, nothing else");
      },
      [&](const messaging::CommonOptions& common) {
        if (list) {
          std::printf("%s", drivers::list_cameras().c_str());
          return 0;
        }
        if (tilt_deg && !(std::abs(*tilt_deg) <= 27.0)) {
          throw messaging::ConfigError("--tilt must be from -27 to 27 degrees");
        }
        if (tilt_deg) camera.tilt = geometry::radians(*tilt_deg);
        camera.lossless = live_options.lossless;
        const auto config = common.config.read<drivers::KinectConfig>("kinect");
        const drivers::CameraSource source{
            .open = drivers::camera_opener(camera, config),
            .is_recording = camera.is_playback(),
            .is_recorded = !camera.recording.empty(),
            .keeps_sensor_time = camera.is_playback() && camera.lossless,
            .known = camera_file.empty() ? drivers::CameraFile()
                                         : drivers::read_camera_file(camera_file)};
        messaging::LiveProcess live("geomap-kinect", common, live_options);
        drivers::KinectProcess process(config, source, live);
        return live.run([&] { process.finish(); }, [&] { return process.summary(); });
      });
}
