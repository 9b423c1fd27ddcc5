// SPDX-License-Identifier: BSD-3-Clause
#include "perception/rigid_transform.hpp"

#include <numbers>

namespace geomap::perception {

bool is_rigid(const Eigen::Isometry3d& T) {
  constexpr double kTolerance = 1e-6;
  if (!T.matrix().allFinite()) return false;
  const Eigen::Matrix3d R = T.linear();
  return (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < kTolerance &&
         R.determinant() > 0.0;
}

Eigen::Isometry3d orthonormal(const Eigen::Isometry3d& T) {
  Eigen::Isometry3d result = T;
  result.linear() = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
  return result;
}

double angle_between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::Quaterniond(a.linear()).angularDistance(Eigen::Quaterniond(b.linear()));
}

Eigen::Isometry3d interpolate(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b,
                              double fraction) {
  // Normalised, because a pose from a file is orthonormal only to the digits it was written with.
  const Eigen::Quaterniond q_a = Eigen::Quaterniond(a.linear()).normalized();
  const Eigen::Quaterniond q_b = Eigen::Quaterniond(b.linear()).normalized();
  const Eigen::AngleAxisd turn(q_a.conjugate() * q_b);
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  // AngleAxis of a quaternion with w < 0 turns the long way round in some versions of Eigen.
  const double angle =
      turn.angle() > std::numbers::pi ? turn.angle() - 2.0 * std::numbers::pi : turn.angle();
  result.linear() = (q_a * Eigen::AngleAxisd(fraction * angle, turn.axis())).toRotationMatrix();
  result.translation() = a.translation() + fraction * (b.translation() - a.translation());
  return result;
}

}  // namespace geomap::perception
