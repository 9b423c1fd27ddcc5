// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace geomap::drivers {

/// @brief How an odometry drifts that is made from true poses.
struct OdometryDriftConfig {
  double drift_m_per_m = 0.02;   // translation error per path length [m/m]
  double drift_deg_per_m = 1.0;  // rotation error per path length [deg/m]
  int seed = 1;                  // which directions the two errors have

  std::vector<std::string> validate() const;

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& visitor) {
    visitor("drift_m_per_m", self.drift_m_per_m);
    visitor("drift_deg_per_m", self.drift_deg_per_m);
    visitor("seed", self.seed);
  }
};

/// @brief Turns true poses of a robot into those of a drifting odometry.
///
/// Every step D of the true motion becomes D exp(xi |D|), |D| its path length [m] and xi one
/// constant twist (in the body's frame) whose two directions the seed decides. Exact at the first
/// pose; a robot that stands or only turns does not drift. The same seed gives the same numbers
/// with every standard library: none of its distributions is used.
class OdometryDrift {
 public:
  /// @throws std::invalid_argument with the first message of config.validate().
  explicit OdometryDrift(const OdometryDriftConfig& config);

  /// @brief The odometry's T_odom_body at the pose that follows the one of the call before.
  Eigen::Isometry3d next(const Eigen::Isometry3d& T_world_body);

  /// @brief xi: translation [m/m], then rotation vector [rad/m].
  const Eigen::Matrix<double, 6, 1>& bias() const { return bias_; }

 private:
  Eigen::Matrix<double, 6, 1> bias_;
  std::optional<Eigen::Isometry3d> T_world_previous_;
  Eigen::Isometry3d T_odom_body_ = Eigen::Isometry3d::Identity();
};

}  // namespace geomap::drivers
