// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "viewer/image.hpp"

namespace geomap::viewer {

/// @brief Writes a picture whole, or leaves what was there. @throws std::runtime_error, one line
/// with the path, when it cannot be written; std::invalid_argument when the picture has no pixels,
/// or not as many as its size says.
void write_png(const std::filesystem::path& path, const Image& image);

/// @brief @throws std::runtime_error, one line with the path, when it is missing or not a PNG.
Image read_png(const std::filesystem::path& path);

}  // namespace geomap::viewer
