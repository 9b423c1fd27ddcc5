// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "geometry/camera_model.hpp"

namespace geomap::drivers {

/// @brief The camera of the simulator: 640x480, 57 x 43 degrees, as the paper says of a Kinect.
inline geometry::CameraModel simulated_kinect() {
  geometry::CameraModel camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = 589.366;  // 320 / tan(57° / 2)
  camera.fy = 609.275;  // 240 / tan(43° / 2)
  camera.cx = 319.5;
  camera.cy = 239.5;
  return camera;
}

}  // namespace geomap::drivers
