// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "geometry/rgbd_frame.hpp"

namespace geomap::drivers {

/// Images wider or higher than this are refused, whatever their files claim.
inline constexpr int kMaxImageSide = 8192;  // [pixel]

/// @brief A JPEG file as it is: bytes that need no decoding, and the size its header gives.
struct JpegFile {
  std::vector<std::uint8_t> bytes;
  int width = 0;
  int height = 0;
};

/// @brief Depth from a 16-bit grey PNG, rounded to millimetres. 0 and 65535 mean no reading in
/// every format read here; both become DepthImage::kNoReading.
/// @param units_per_metre what the file counts: 1000 for millimetres, 5000 for TUM RGB-D.
/// @throws SourceError naming the file: missing, truncated, corrupt, too large, not 16-bit grey.
geometry::DepthImage read_depth_png(const std::filesystem::path& path, int units_per_metre = 1000);

/// @brief Colour from a PNG of any kind: grey, palette, RGB, with or without alpha (dropped).
/// @throws SourceError naming the file: missing, truncated, corrupt, too large.
geometry::ColorImage read_color_png(const std::filesystem::path& path);

/// @brief A JPEG file's bytes, after a look at its markers: start, frame header, scan, end.
/// @throws SourceError naming the file: missing, truncated, no JPEG, too large.
JpegFile read_jpeg(const std::filesystem::path& path);

}  // namespace geomap::drivers
