// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "drivers/frame_source.hpp"

namespace geomap::drivers {

/// @brief The camera after its whole image was scaled to another size: pixel centres stay pixel
/// centres. Intrinsics that a data set publishes hold for 640 x 480 only.
geometry::CameraModel resized(const geometry::CameraModel& camera, int width, int height);

/// @brief Colour from a file into `out`: bytes as they are from .jpg and .jpeg, pixels from all
/// else; sets the size of out.frame.color_camera.
/// @throws SourceError naming the file.
void load_color(const std::filesystem::path& path, SourceFrame& out);

/// @brief A range for people: "0 to 20", "from 600 on".
std::string to_string(const FrameRange& range);

}  // namespace geomap::drivers
