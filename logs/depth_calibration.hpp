// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "geometry/camera_model.hpp"
#include "geometry/depth_correction.hpp"
#include "messaging/config.hpp"

namespace geomap::logs {

/// @brief What a log tells of its camera's depth.
struct DepthCalibration {
  geometry::DepthCorrection correction;  // none where it is too small to matter
  double largest = 0.0;         // size of what was found over the image, a share of the depth
  double sigma = 0.0;           // its largest standard deviation, likewise
  geometry::CameraModel depth;  // of the log's frames
  std::optional<geometry::CameraModel> color;  // where they have colour
  std::int64_t frames = 0;
  std::size_t keyframes = 0;  // that were compared
  bool stopped = false;       // by Ctrl-C
};

/// @brief Estimates the smooth distortion of a camera's depth from a log in which it sees the same
/// surfaces, best walls, at different places of the image: registration as in a replay, with the
/// estimator that learns while mapping, but hardly any belief that a camera is good.
/// @throws std::runtime_error when the log cannot be read, has no frames, or shows too little.
DepthCalibration calibrate_depth(const std::string& log, const messaging::Config& config);

}  // namespace geomap::logs
