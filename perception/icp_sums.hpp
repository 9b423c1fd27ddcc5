// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace geomap::perception {

/// @brief Normal equations of one step of frustum ICP, about the camera's centre in the world's
/// axes: translation [m] before rotation [rad].
struct IcpSums {
  std::array<double, 21> information{};  // upper triangle, row by row
  std::array<double, 6> vector{};
  double weight = 0.0;
  double squares = 0.0;         // Σ w e²
  double radius_squares = 0.0;  // Σ w |p|²
  int partners = 0;
  int seen_through = 0;  // surfels nearer than the view's surface by more than the gate

  Eigen::Matrix<double, 6, 6> matrix() const {
    Eigen::Matrix<double, 6, 6> m;
    for (int r = 0, k = 0; r < 6; ++r) {
      for (int c = r; c < 6; ++c, ++k) m(r, c) = m(c, r) = information[static_cast<std::size_t>(k)];
    }
    return m;
  }
  /// @brief rms distance of the partners from the camera, never below 0.1 m; needs partners.
  double radius() const { return std::max(0.1, std::sqrt(radius_squares / weight)); }
};

}  // namespace geomap::perception
