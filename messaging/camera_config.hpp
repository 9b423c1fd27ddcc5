// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "geometry/camera_model.hpp"

namespace geomap::messaging {

/// @brief A pinhole camera given by settings. Defaults: Kinect v1, depth registered to colour.
struct CameraConfig {
  int width = 640;    // [pixel]
  int height = 480;   // [pixel]
  double fx = 525.0;  // [pixel]
  double fy = 525.0;  // [pixel]
  double cx = 319.5;  // [pixel]
  double cy = 239.5;  // [pixel]

  geometry::CameraModel camera() const { return {width, height, fx, fy, cx, cy}; }

  std::vector<std::string> validate() const {
    if (camera().valid()) return {};
    return {"width, height, fx and fy must be positive, and everything finite"};
  }

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& visitor) {
    visitor("width", self.width);
    visitor("height", self.height);
    visitor("fx", self.fx);
    visitor("fy", self.fy);
    visitor("cx", self.cx);
    visitor("cy", self.cy);
  }
};

}  // namespace geomap::messaging
