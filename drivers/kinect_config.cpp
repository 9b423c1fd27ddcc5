// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/kinect_config.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace geomap::drivers {

std::vector<std::string> KinectConfig::validate() const {
  std::vector<std::string> messages;
  if (width <= 0 || height <= 0) messages.push_back("width and height must be positive");
  if (rate < 1 || rate > 1000) messages.push_back("rate must be from 1 to 1000");
  if (jpeg_quality < 1 || jpeg_quality > 100) {
    messages.push_back("jpeg_quality must be from 1 to 100");
  }
  constexpr std::array kLeds = {"off", "green", "red", "yellow", "blink"};
  if (std::find(kLeds.begin(), kLeds.end(), led) == kLeds.end()) {
    messages.push_back("led must be off, green, red, yellow or blink");
  }
  if (!(timeout > 0.0)) messages.push_back("timeout must be positive");
  const bool from_fov = fx == 0.0 && fy == 0.0;
  if (!from_fov && !(fx > 0.0 && fy > 0.0)) {
    messages.push_back("fx and fy must both be positive, or both 0");
  }
  return messages;
}

geometry::CameraModel KinectConfig::camera(double horizontal_fov, double vertical_fov) const {
  if (fx > 0.0) return {width, height, fx, fy, cx, cy};
  return {width,
          height,
          0.5 * width / std::tan(0.5 * horizontal_fov),
          0.5 * height / std::tan(0.5 * vertical_fov),
          0.5 * (width - 1),
          0.5 * (height - 1)};
}

}  // namespace geomap::drivers
