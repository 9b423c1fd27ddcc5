// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "drivers/kinect_config.hpp"
#include "drivers/rgbd_camera.hpp"

namespace geomap::drivers {

/// @brief What libfreenect shall open.
struct FreenectOptions {
  std::string device;          // number, see list_freenect(), or serial; empty: the first one
  std::optional<double> tilt;  // of the motor [rad]; none: as it is
};

/// @brief Opens a Kinect v1 through libfreenect: 640x480 at 30 a second. Depth is in millimetres,
/// registered to colour by the library where that is wanted; from a library that hands out nothing
/// but disparities it is converted with nominal constants, and not registered.
/// @throws SourceError when there is none, another process has it, or another mode is wanted.
std::unique_ptr<RgbdCamera> open_freenect(const FreenectOptions& options,
                                          const KinectConfig& config);

/// @brief All Kinects and their modes, for people.
std::string list_freenect();

}  // namespace geomap::drivers
