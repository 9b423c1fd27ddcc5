// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/camera_model.hpp"

namespace geomap::geometry {

/// @brief Depth image, row by row without padding, in millimetres along the optical axis.
struct DepthImage {
  static constexpr std::uint16_t kNoReading = 0;     // nothing measured
  static constexpr std::uint16_t kInvalid = 0xffff;  // 7-Scenes' way of saying the same

  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> millimetres;

  bool empty() const { return millimetres.empty(); }
  std::uint16_t at(int u, int v) const {
    return millimetres[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
                       static_cast<std::size_t>(u)];
  }
  static bool is_reading(std::uint16_t value) { return value != kNoReading && value != kInvalid; }
};

/// @brief Colour image, row by row without padding, 3 bytes a pixel: red, green, blue.
struct ColorImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;

  bool empty() const { return rgb.empty(); }
};

/// @brief One reading of an RGB-D camera. Colour may be absent (empty). Where both images have the
/// same size, pixel (u, v) of colour is taken as the colour of pixel (u, v) of depth.
struct RgbdFrame {
  std::int64_t utime = 0;  // [us] of the sensor
  std::int64_t sequence = 0;
  std::string sensor;
  DepthImage depth;
  ColorImage color;
  CameraModel depth_camera;
  CameraModel color_camera;
};

}  // namespace geomap::geometry
