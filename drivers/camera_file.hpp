// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "geometry/camera_model.hpp"
#include "geometry/depth_correction.hpp"

namespace geomap::drivers {

/// @brief What is known of one camera, config/cameras/NAME.yaml:
///
///     name: Kinect v1
///     depth: {width: 640, height: 480, fx: 575.8, fy: 575.8, cx: 319.5, cy: 239.5}  # or missing
///     color: {width: 640, height: 480, fx: 525, fy: 525, cx: 319.5, cy: 239.5}      # or missing
///     depth_correction: [...]  # 14 numbers by geomap-calibrate-depth, or missing
struct CameraFile {
  std::string name;
  std::optional<geometry::CameraModel> depth;  // of depth that is not registered to colour
  std::optional<geometry::CameraModel> color;  // of colour, and of depth that is registered to it
  geometry::DepthCorrection correction;
};

/// @throws SourceError "FILE:LINE: what" when it cannot be read, is not YAML, or has a key or a
/// value that makes no sense.
CameraFile read_camera_file(const std::filesystem::path& path);

/// @brief Every number comes back to the last bit; the old file stays until the new one is whole.
/// @throws SourceError naming the file when it cannot be written.
void write_camera_file(const CameraFile& camera, const std::filesystem::path& path);

}  // namespace geomap::drivers
