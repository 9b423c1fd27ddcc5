// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "geometry/rgbd_frame.hpp"

namespace geomap::geometry {

/// @brief A depth camera's fixed error as a smooth share of the depth that depends on the place in
/// the image: z_true = z · (1 + s(x, y)), s a polynomial of degree 4 without a constant term in the
/// viewing ray (x, y, 1). A constant would be the scale of the world, which depth alone cannot
/// tell.
class DepthCorrection {
 public:
  static constexpr int kTerms = 14;       // monomials of degree 1 to 4
  static constexpr int kLinearTerms = 2;  // come first
  using Terms = Eigen::Matrix<double, kTerms, 1>;

  DepthCorrection() : coefficients_(Terms::Zero()) {}
  explicit DepthCorrection(const Terms& coefficients) : coefficients_(coefficients) {}

  /// @brief Monomials at a viewing ray; about 1 at the border of a Kinect's image.
  static Terms terms(double ray_x, double ray_y);

  /// @brief s at a viewing ray.
  double share(double ray_x, double ray_y) const { return coefficients_.dot(terms(ray_x, ray_y)); }
  const Terms& coefficients() const { return coefficients_; }
  bool is_none() const { return (coefficients_.array() == 0.0).all(); }

  /// @brief Largest difference of s between two corrections over the image of a camera.
  static double largest_difference(const DepthCorrection& a, const DepthCorrection& b,
                                   const CameraModel& camera);

 private:
  Terms coefficients_;
};

/// @brief The frame with corrected depth, rounded to the millimetre. Pixels without a reading, and
/// readings that the correction would take out of the image's range, are left as they are.
/// @throws std::invalid_argument when depth image and camera disagree in size.
RgbdFrame corrected(const RgbdFrame& frame, const DepthCorrection& correction);

}  // namespace geomap::geometry
