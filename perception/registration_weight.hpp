// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "geometry/depth_noise.hpp"

namespace geomap::perception {

/// @brief Weight [1/m²] of a point-to-plane residual [m] at depth `z` [m]: the inverse of the
/// variance that twice a Kinect's noise and its systematic error (a share of the depth) give, times
/// Cauchy's robust weight, which a residual of 1 cm halves. Chosen by measurement, see
/// docs/decisions.md: it falls from z⁻² near the camera to z⁻⁴ far off.
inline double registration_weight(double z, double residual) {
  constexpr double kSystematic = 0.006;  // share of the depth
  constexpr double kCauchy = 0.01;       // [m]
  constexpr double kNoiseFactor = 2.0;
  constexpr geometry::DepthNoise kKinect{};
  const double beyond = z - kKinect.nearest;
  const double noise = kNoiseFactor * (kKinect.base + kKinect.slope * beyond * beyond);
  const double systematic = kSystematic * z;
  const double outlier = residual / kCauchy;
  return 1.0 / ((noise * noise + systematic * systematic) * (1.0 + outlier * outlier));
}

}  // namespace geomap::perception
