// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/kinect_disparity.hpp"

#include <algorithm>
#include <cmath>

namespace geomap::drivers {
namespace {

constexpr double kZeroPlane = 1200.0;     // [mm]
constexpr double kPixelSize = 1.042;      // of 1280 in a row, on the zero plane [mm]
constexpr double kBaseline = 75.0;        // from camera to projector [mm]
constexpr double kZeroDisparity = 800.0;  // of the zero plane, but for
constexpr double kOffset = 0.375;         // [pixel]
constexpr double kSteps = 4.0;            // disparities in a pixel
constexpr double kFarthest = 10000.0;     // [mm]

}  // namespace

std::uint16_t millimetres_of_disparity(std::uint16_t disparity) {
  if (disparity >= kNoDisparity) return 0;
  const double shift = ((disparity - kZeroDisparity) / kSteps - kOffset) * kPixelSize;  // [mm]
  if (shift >= kBaseline) return 0;
  const double depth = kZeroPlane * kBaseline / (kBaseline - shift);
  return depth > kFarthest ? 0 : static_cast<std::uint16_t>(std::lround(depth));
}

std::uint16_t disparity_of_millimetres(std::uint16_t millimetres) {
  if (millimetres == 0 || millimetres > kFarthest) return kNoDisparity;
  const double shift = kBaseline * (1.0 - kZeroPlane / millimetres);
  const double disparity = kZeroDisparity + kSteps * (shift / kPixelSize + kOffset);
  return static_cast<std::uint16_t>(std::clamp(std::round(disparity), 0.0, kNoDisparity - 1.0));
}

geometry::CameraModel nominal_kinect_depth_camera() {
  constexpr double kFocalLength = kZeroPlane / (2.0 * kPixelSize);
  return {640, 480, kFocalLength, kFocalLength, 319.5, 239.5};
}

geometry::CameraModel nominal_kinect_color_camera() {
  return {640, 480, 525.0, 525.0, 319.5, 239.5};
}

}  // namespace geomap::drivers
