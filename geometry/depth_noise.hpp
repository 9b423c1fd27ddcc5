// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

namespace geomap::geometry {

/// @brief Standard deviation of a depth reading against its depth, the one source of every
/// tolerance, weight and gate: σ_z(z) = factor · (base + slope · (z - nearest)²), never below what
/// rounding to the depth unit leaves. Defaults: Kinect v1, after Nguyen, Izadi, Lovell, "Modeling
/// Kinect Sensor Noise for Improved 3D Reconstruction and Tracking" (3DIMPVT 2012).
struct DepthNoise {
  double base = 0.0012;         // [m]
  double slope = 0.0019;        // [1/m]
  double nearest = 0.4;         // [m]
  double factor = 1.0;          // of one frame, see perception/noise_estimate.hpp
  double quantisation = 0.001;  // step of the depth readings [m]

  /// @brief σ_z [m] at depth z [m].
  double sigma(double z) const {
    const double beyond = z - nearest;
    constexpr double kRootOfTwelve =
        3.4641016151377544;  // rms of a uniform rounding error: step/√12
    return std::max(factor * (base + slope * beyond * beyond), quantisation / kRootOfTwelve);
  }
};

}  // namespace geomap::geometry
