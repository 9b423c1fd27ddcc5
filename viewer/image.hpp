// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace geomap::viewer {

/// @brief Picture, row by row from the top without padding, 3 bytes a pixel: red, green, blue.
struct Image {
  int width = 0;   // [px]
  int height = 0;  // [px]
  std::vector<std::uint8_t> rgb;
  bool operator==(const Image&) const = default;
};

}  // namespace geomap::viewer
