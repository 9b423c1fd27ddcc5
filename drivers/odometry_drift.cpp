// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/odometry_drift.hpp"

#include <cmath>
#include <random>
#include <stdexcept>

#include "geometry/angles.hpp"

namespace geomap::drivers {
namespace {

using Eigen::Vector3d;

// [-1, 1), from the upper 53 bits: std::uniform_real_distribution differs between libraries.
double symmetric_uniform(std::mt19937_64& generator) {
  return std::ldexp(static_cast<double>(generator() >> 11), -52) - 1.0;
}

// Uniform on the sphere, by rejection from the cube.
Vector3d random_direction(std::mt19937_64& generator) {
  while (true) {
    Vector3d v;
    for (int i = 0; i < 3; ++i) v[i] = symmetric_uniform(generator);
    const double length = v.norm();
    if (length > 0.1 && length <= 1.0) return v / length;
  }
}

// Exponential map of SE(3), translation first; Barfoot, State Estimation for Robotics,
// eq. 7.85-7.87.
Eigen::Isometry3d exponential(const Eigen::Matrix<double, 6, 1>& xi) {
  const Vector3d rho = xi.head<3>();
  const Vector3d phi = xi.tail<3>();
  const double angle = phi.norm();
  // (1 - cos a) / a² and (a - sin a) / a³; their limits where the fractions lose all digits.
  const bool small = angle < 1e-4;
  const double a2 = angle * angle;
  const double b = small ? 0.5 : (1.0 - std::cos(angle)) / a2;
  const double c = small ? 1.0 / 6.0 : (angle - std::sin(angle)) / (a2 * angle);
  const Vector3d turned = phi.cross(rho);

  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  if (angle > 0.0) T.linear() = Eigen::AngleAxisd(angle, phi / angle).toRotationMatrix();
  T.translation() = rho + b * turned + c * phi.cross(turned);
  return T;
}

}  // namespace

std::vector<std::string> OdometryDriftConfig::validate() const {
  std::vector<std::string> messages;
  if (!std::isfinite(drift_m_per_m) || drift_m_per_m < 0.0) {
    messages.push_back("drift_m_per_m must be 0 or more");
  }
  if (!std::isfinite(drift_deg_per_m) || drift_deg_per_m < 0.0) {
    messages.push_back("drift_deg_per_m must be 0 or more");
  }
  if (seed < 0) messages.push_back("seed must be 0 or more");
  return messages;
}

OdometryDrift::OdometryDrift(const OdometryDriftConfig& config) {
  const std::vector<std::string> messages = config.validate();
  if (!messages.empty()) throw std::invalid_argument(messages.front());
  std::mt19937_64 generator(static_cast<std::uint64_t>(config.seed));
  bias_.head<3>() = config.drift_m_per_m * random_direction(generator);
  bias_.tail<3>() = geometry::radians(config.drift_deg_per_m) * random_direction(generator);
}

Eigen::Isometry3d OdometryDrift::next(const Eigen::Isometry3d& T_world_body) {
  if (!T_world_previous_) {
    T_odom_body_ = T_world_body;
  } else {
    const Eigen::Isometry3d step = T_world_previous_->inverse() * T_world_body;
    T_odom_body_ = T_odom_body_ * step * exponential(bias_ * step.translation().norm());
    // Thousands of products: keep the rotation a rotation.
    T_odom_body_.linear() = Eigen::Quaterniond(T_odom_body_.linear()).normalized().matrix();
  }
  T_world_previous_ = T_world_body;
  return T_odom_body_;
}

}  // namespace geomap::drivers
