// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "geometry/depth_noise.hpp"

namespace geomap::perception {

/// @brief How far along the viewing ray a reading may be from the surface it belongs to: a multiple
/// of the noise, plus the camera's systematic error, which is a share of the depth. A frame with
/// next to no noise, or with white noise, is from a simulator and is not granted a camera's
/// systematic error.
struct DepthTolerance {
  geometry::DepthNoise noise;  // of the frame
  double gate = 3.0;           // [sigma]
  double systematic = 0.005;   // share of the depth
  double unevenness =
      0.001;  // of surfaces that count as flat, along the normal, beside the rest [m]

  /// @brief Noise that is the same at every depth: a simulator's, and known well.
  bool is_white() const { return !(noise.slope > 0.0); }

  /// @brief 1 for a camera's noise, 0 for a simulator's.
  double camera_share() const {
    // From a rendering's rounded depth to what cameras with smoothed depth come down to [factor].
    constexpr double kRendered = 0.1, kCamera = 0.3;
    return is_white() ? 0.0
                      : std::clamp((noise.factor - kRendered) / (kCamera - kRendered), 0.0, 1.0);
  }

  double systematic_along_ray(double z) const { return camera_share() * systematic * z; }

  double along_ray(double z) const { return gate * noise.sigma(z) + systematic_along_ray(z); }
};

}  // namespace geomap::perception
