// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "geometry/camera_model.hpp"

namespace geomap::drivers {

/// @brief No reading, as an 11-bit disparity.
inline constexpr std::uint16_t kNoDisparity = 2047;

/// @brief Depth that a Kinect v1 measures as an 11-bit disparity against its zero plane.
///
/// The constants are nominal, as libfreenect has them for a camera that it did not ask for its own:
/// the zero plane at 1200 mm, where a pixel of 1280 is 1.042 mm wide, and the projector 75 mm
/// beside the camera.
/// @return [mm]; 0 for no reading, and for what lies beyond 10 m.
std::uint16_t millimetres_of_disparity(std::uint16_t disparity);

/// @brief The inverse: the nearest disparity. @return kNoDisparity for 0, or beyond 10 m.
std::uint16_t disparity_of_millimetres(std::uint16_t millimetres);

/// @brief The Kinect v1's depth camera, from the same constants; its principal point is nominal
/// too.
geometry::CameraModel nominal_kinect_depth_camera();

/// @brief Its colour camera, and that of depth which is registered to colour, as OpenNI has it.
geometry::CameraModel nominal_kinect_color_camera();

}  // namespace geomap::drivers
