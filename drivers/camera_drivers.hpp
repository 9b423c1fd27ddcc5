// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "drivers/camera_thread.hpp"
#include "drivers/kinect_config.hpp"

namespace geomap::drivers {

/// @brief Which camera, and what to do with it.
struct CameraOptions {
  std::string driver;          // "openni2", "freenect", or empty: the first that finds a camera
  std::string device;          // as list_cameras() tells, or FILE.oni; empty: any camera
  std::string recording;       // FILE.oni to write, of OpenNI2; empty: none
  std::optional<double> tilt;  // of a Kinect's motor [rad]
  bool lossless = false;       // every image of a recording, as fast as they are taken

  bool is_playback() const { return device.ends_with(".oni"); }
};

/// @brief What opens the camera. @throws std::invalid_argument when options contradict each other.
CameraThread::Open camera_opener(const CameraOptions& options, const KinectConfig& config);

/// @brief The cameras of all drivers and their modes, for people.
std::string list_cameras();

}  // namespace geomap::drivers
