// SPDX-License-Identifier: BSD-3-Clause
// geomap-calibrate-depth: the smooth distortion of a camera's depth, from a log.
#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "drivers/camera_file.hpp"
#include "logs/depth_calibration.hpp"
#include "messaging/program.hpp"

namespace {

using namespace geomap;

// What the file says beside the correction stays, where it fits.
drivers::CameraFile updated(const std::string& path, const logs::DepthCalibration& calibration) {
  if (!std::filesystem::exists(path)) {
    return {std::filesystem::path(path).stem().string(), calibration.depth, calibration.color,
            calibration.correction};
  }
  drivers::CameraFile file = drivers::read_camera_file(path);
  const bool is_of_log = file.depth == calibration.depth || file.color == calibration.depth;
  if ((file.depth || file.color) && !is_of_log) {
    throw std::runtime_error(path + " has other intrinsics than the log's depth: they belong " +
                             "together, so write to another file");
  }
  if (calibration.correction.is_none() && !file.correction.is_none()) {
    throw std::runtime_error(path + " keeps its correction, as this log shows none: is its depth " +
                             "corrected already? Else write to another file");
  }
  file.correction = calibration.correction;
  return file;
}

int run(const std::string& log, const std::string& output, const messaging::Config& config) {
  if (std::filesystem::exists(output)) drivers::read_camera_file(output);  // a wrong name ends here
  const logs::DepthCalibration calibration = logs::calibrate_depth(log, config);
  if (calibration.stopped) {
    fmt::print("stopped: {} is as it was\n", output);
    return 1;
  }
  drivers::write_camera_file(updated(output, calibration), output);
  fmt::print("{} key frames of {} frames: depth is off by up to {:.2f} % +- {:.2f} %\n{}: {}\n",
             calibration.keyframes, calibration.frames, 100.0 * calibration.largest,
             100.0 * calibration.sigma, output,
             calibration.correction.is_none() ? "no correction, it would be too small to matter"
                                              : "depth_correction");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::string log;
  std::string output;
  return messaging::run_program(
      argc, argv,
      {.name = "geomap-calibrate-depth",
       .description = "Estimates the smooth distortion of a camera's depth from a log in which it "
                      "sees walls at different places of the image."},
      [&](messaging::OptionParser& parser) {
        parser.positional("LOG", log, "LCM log with RGBD_FRAME, not corrected yet, and POSE");
        parser.required("-o,--output", output,
                        "camera file for --camera; of one that exists only the correction changes");
      },
      [&](const messaging::CommonOptions& common) { return run(log, output, common.config); });
}
