// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace geomap::drivers {

// The C library chooses between variants of its functions by what the CPU can do, and their last
// bits differ. These use only operations that IEEE 754 rounds exactly.

struct SineAndCosine {
  double sine = 0.0;
  double cosine = 1.0;
};

/// @brief Both within 1e-15 for |angle| below 1e5 rad.
SineAndCosine portable_sincos(double angle);

/// @brief The rotation by an angle [rad] about an axis; Eigen's own ask the C library.
Eigen::Matrix3d turned_about_x(double angle);
Eigen::Matrix3d turned_about_y(double angle);
Eigen::Matrix3d turned_about_z(double angle);

/// @brief Natural logarithm of a positive, normal number, to about 16 digits.
double portable_log(double x);

}  // namespace geomap::drivers
