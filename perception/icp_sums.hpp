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

  /// @param w weight [1/m²]; @param e residual [m]; @param p from the camera's centre [m]; @param n
  /// unit normal; both in the world's axes.
  void add(double w, double e, const Eigen::Vector3d& p, const Eigen::Vector3d& n) {
    const Eigen::Vector3d m = p.cross(n);
    const std::array<double, 6> j = {n.x(), n.y(), n.z(), m.x(), m.y(), m.z()};
    for (std::size_t r = 0, k = 0; r < 6; ++r) {
      const double wj = w * j[r];
      for (std::size_t c = r; c < 6; ++c) information[k++] += wj * j[c];
      vector[r] += wj * e;
    }
    weight += w;
    squares += w * e * e;
    radius_squares += w * p.squaredNorm();
    ++partners;
  }
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
