// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "geometry/rgbd_frame.hpp"

namespace geomap::messaging {

/// @brief Why a decoded message holds no usable frame.
enum class FrameFault {
  kNone,
  kBadSize,        // sizes are absurd, or images, strides and cameras do not fit together
  kBadFormat,      // a pixel format that is not understood here, or no depth image at all
  kBadDepth,       // depth does not inflate to its size
  kBadJpeg,        // colour does not decode to its size
  kBadIntrinsics,  // focal lengths or centres that are no camera's
  kNoReading       // not one pixel of depth was measured
};

/// @brief Short name for counters and log lines, for example "bad_jpeg".
std::string to_string(FrameFault fault);

/// @brief An image as messages carry it.
struct EncodedImage {
  std::span<const std::uint8_t> data;
  int width = 0;                // [pixel]
  int height = 0;               // [pixel]
  std::int64_t row_stride = 0;  // of the plain image [byte]; 0: rows without padding
  bool compressed = false;      // depth: zlib, colour: JPEG
};

struct DepthResult {
  geometry::DepthImage image;
  FrameFault fault = FrameFault::kNone;
};

struct ColorResult {
  geometry::ColorImage image;
  FrameFault fault = FrameFault::kNone;
};

/// @brief Depth [mm] of little-endian 16-bit rows. An image without one reading is kNoReading.
DepthResult read_depth(const EncodedImage& encoded);

/// @brief Colour of a JPEG stream, or of rows of 3 bytes a pixel.
ColorResult read_color(const EncodedImage& encoded);

}  // namespace geomap::messaging
