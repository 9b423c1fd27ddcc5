// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "drivers/kinect_config.hpp"
#include "drivers/rgbd_camera.hpp"

namespace geomap::drivers {

/// @brief What OpenNI2 shall open.
struct OpenNi2Options {
  std::string device;     // URI, or a recording FILE.oni; empty: any camera
  std::string recording;  // FILE.oni to write; empty: none
  bool lossless = false;  // of a recording every image, as fast as they are taken
};

/// @brief Opens a camera that OpenNI2 drives: PrimeSense, Xtion, or a recording of one.
/// @throws SourceError when there is none, another process has it, or it lacks the mode; then the
/// modes it has are named.
std::unique_ptr<RgbdCamera> open_openni2(const OpenNi2Options& options, const KinectConfig& config);

/// @brief All devices and their modes, for people.
std::string list_openni2();

}  // namespace geomap::drivers
