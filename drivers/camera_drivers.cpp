// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/camera_drivers.hpp"

#include <stdexcept>

#include "drivers/frame_source.hpp"
#include "drivers/freenect_camera.hpp"
#include "drivers/openni2_camera.hpp"

namespace geomap::drivers {
namespace {

void check(const CameraOptions& options) {
  const bool is_openni2 = options.driver != "freenect";
  if (!is_openni2 && options.is_playback()) {
    throw std::invalid_argument("FILE.oni is played by --driver openni2");
  }
  if (!is_openni2 && !options.recording.empty()) {
    throw std::invalid_argument("--record is OpenNI2's; record a Kinect with lcm-logger");
  }
  if (options.is_playback() && !options.recording.empty()) {
    throw std::invalid_argument("a recording is not recorded again: leave out --record");
  }
}

std::unique_ptr<RgbdCamera> open_either(const CameraOptions& options, const KinectConfig& config) {
  std::string reason;
  try {
    return open_openni2(options.device, options.recording, config);
  } catch (const SourceError& error) {
    reason = error.what();
  }
  try {
    return open_freenect({options.device, options.tilt}, config);
  } catch (const SourceError& error) {
    throw SourceError(reason + "; " + error.what());
  }
}

}  // namespace

CameraThread::Open camera_opener(const CameraOptions& options, const KinectConfig& config) {
  check(options);
  if (options.is_playback()) {
    return [=] { return play_openni2(options.device, options.lossless, config); };
  }
  if (options.driver == "freenect") {
    return [=] { return open_freenect({options.device, options.tilt}, config); };
  }
  if (options.driver == "openni2" || !options.recording.empty()) {
    return [=] { return open_openni2(options.device, options.recording, config); };
  }
  return [=] { return open_either(options, config); };
}

std::string list_cameras() {
  const std::string text = list_openni2() + list_freenect();
  return text.empty() ? "no camera\n" : text;
}

}  // namespace geomap::drivers
