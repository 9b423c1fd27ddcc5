// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "drivers/kinect_config.hpp"
#include "drivers/rgbd_camera.hpp"

namespace geomap::drivers {

/// @brief Opens a camera that OpenNI2 drives: PrimeSense or Xtion.
/// @param uri as list_openni2() tells; empty: any camera.
/// @param recording FILE.oni to write, or FILE-2.oni and so on where it is there; empty: none.
/// @throws SourceError when there is none, another process has it, or it lacks the mode; then the
/// modes it has are named.
std::unique_ptr<RgbdCamera> open_openni2(const std::string& uri, const std::string& recording,
                                         const KinectConfig& config);

/// @brief A recording, FILE.oni, that ends. Its images have the size they have.
/// @param lossless every image, as fast as they are taken; else at the recording's own pace.
/// @throws SourceError when it is no recording, or not a whole one.
std::unique_ptr<RgbdCamera> play_openni2(const std::filesystem::path& recording, bool lossless,
                                         const KinectConfig& config);

/// @brief All devices and their modes, for people.
std::string list_openni2();

}  // namespace geomap::drivers
