// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace geomap::drivers {

/// @brief How a camera is run.
struct KinectConfig {
  int width = 640;         // of depth and colour [pixel]
  int height = 480;        // [pixel]
  int rate = 30;           // frames a second
  bool registered = true;  // depth is put into the colour camera's view, where the device can
  int jpeg_quality = 90;
  std::string led = "green";  // of a Kinect while it is used: off, green, red, yellow or blink
  double timeout = 1.0;       // without an image, after which the camera is opened anew [s]

  std::vector<std::string> validate() const;

  /// @brief Half the time between two frames [us].
  std::int64_t pairing_tolerance() const { return 500'000 / rate; }

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& visitor) {
    visitor("width", self.width);
    visitor("height", self.height);
    visitor("rate", self.rate);
    visitor("registered", self.registered);
    visitor("jpeg_quality", self.jpeg_quality);
    visitor("led", self.led);
    visitor("timeout", self.timeout);
  }
};

}  // namespace geomap::drivers
