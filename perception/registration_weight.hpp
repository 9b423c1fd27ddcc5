// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "geometry/depth_noise.hpp"

namespace geomap::perception {

/// @brief Weight [1/m²] of a point-to-plane residual [m] at depth `z` [m]: the inverse of the
/// variance that a reading's noise and the camera's systematic error (a share of the depth, as
/// plane extraction grants it) give, times Cauchy's robust weight, which a residual of 1 cm halves.
inline double registration_weight(double z, double residual) {
  constexpr double kSystematic = 0.006;  // share of the depth
  constexpr double kCauchy = 0.01;       // [m]
  constexpr geometry::DepthNoise kNoise{};
  const double beyond = z - kNoise.nearest;
  const double noise = kNoise.base + kNoise.slope * beyond * beyond;
  const double systematic = kSystematic * z;
  const double outlier = residual / kCauchy;
  return 1.0 / ((noise * noise + systematic * systematic) * (1.0 + outlier * outlier));
}

}  // namespace geomap::perception
