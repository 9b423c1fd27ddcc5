// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/kinect_config.hpp"

#include <algorithm>
#include <array>

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
  return messages;
}

}  // namespace geomap::drivers
