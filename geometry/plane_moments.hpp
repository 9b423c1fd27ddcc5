// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>

#include "geometry/plane.hpp"

namespace geomap::geometry {

/// @brief A plane fitted to moments, with its uncertainty. Same frame as the moments; metres,
/// radians.
struct PlaneFit {
  Plane plane;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // columns: major, minor direction, normal
  Eigen::Vector2d extent = Eigen::Vector2d::Zero();    // variance along major and minor [m²]
  double rms = 0.0;                                    // of the points about the plane [m]
  /// Covariance of (turn about the minor axis, turn about the major axis, offset at the centroid)
  /// [rad², rad², m²]. It counts a weight as inverse variance, so it is exact for a surface facing
  /// the camera and conservative for an oblique one.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();

  /// @brief Standard deviation of the normal's worst direction [rad].
  double sigma_angle() const;
  /// @brief Standard deviation of the offset [m] at a point: offset at the centroid plus lever arm.
  double sigma_offset(const Eigen::Vector3d& at) const;
};

/// @brief The 16 additive numbers from which a plane is fitted without the bias of depth noise.
///
/// A depth sensor's noise lies along the viewing ray r = p / z, not along the normal, so the plain
/// second moments of an oblique or small patch tilt its fit, and averaging views never removes it.
/// Keeping the expected noise term Σ w σ_z² r rᵀ beside Σ w p pᵀ lets the fit subtract it: the
/// eigenvector of the smallest eigenvalue of (scatter - noise).
/// Weights are inverse variances 1/σ_z² [1/m²], so that the total weight is the information on the
/// offset. The moments refer to the origin of their frame: keep that origin near the points.
struct PlaneMoments {
  double weight = 0.0;                               // Σ w
  Eigen::Vector3d first = Eigen::Vector3d::Zero();   // Σ w p
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  // Σ w p pᵀ, symmetric
  Eigen::Matrix3d noise = Eigen::Matrix3d::Zero();   // Σ w σ_z² r rᵀ, symmetric

  /// @brief Adds a point of the camera frame (optical: z forward, z > 0) with σ_z [m], w = 1/σ_z².
  void add(const Eigen::Vector3d& p_camera, double sigma_z);

  PlaneMoments& operator+=(const PlaneMoments& other);

  /// @brief All sums times `factor`: the same plane with less information.
  PlaneMoments scaled(double factor) const;
  /// @brief Scaled down, never up, so that the total weight is at most `max_weight` [1/m²].
  PlaneMoments capped(double max_weight) const;

  /// @brief The same points in the frame `target`, given in the frame `source`.
  PlaneMoments transformed(const Eigen::Isometry3d& T_target_source) const;

  /// @brief Mean of the points; requires weight > 0.
  Eigen::Vector3d centroid() const { return first / weight; }

  /// @brief The plane, its normal on the side of `side` (n·side >= 0); nothing when the points do
  /// not span a plane (fewer than three, collinear, or all equal).
  std::optional<PlaneFit> fit(const Eigen::Vector3d& side) const;

  /// @brief weight, first (3), second (xx xy xz yy yz zz), noise (same order).
  std::array<double, 16> to_array() const;
  static PlaneMoments from_array(const std::array<double, 16>& values);
};

}  // namespace geomap::geometry
