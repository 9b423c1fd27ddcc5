// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "logs/trajectory_file.hpp"

namespace geomap::logs {

/// @brief An estimated pose and the reference's nearest in time. The two worlds need not agree.
struct PosePair {
  std::int64_t utime = 0;  // of the reference [us]
  Eigen::Isometry3d T_world_estimate = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_world_reference = Eigen::Isometry3d::Identity();
};

/// @brief Of a series of errors, as the TUM RGB-D benchmark's scripts give them: the median of an
/// even number is the mean of the middle two, the deviation divides by n. Zeros where count is 0.
struct ErrorStatistics {
  std::size_t count = 0;
  double rmse = 0.0;
  double mean = 0.0;
  double median = 0.0;
  double max = 0.0;
  double deviation = 0.0;
};

/// @brief Absolute trajectory error (ATE): |T_reference_estimate p_estimate - p_reference| [m].
struct AbsoluteError {
  /// The rigid motion that was applied to the whole estimate.
  Eigen::Isometry3d T_reference_estimate = Eigen::Isometry3d::Identity();
  std::vector<double> errors;  // one for each pair [m]
  ErrorStatistics statistics;  // [m]
};

/// @brief How far one pose is from another.
struct PoseDifference {
  double translation = 0.0;  // [m]
  double rotation = 0.0;     // [rad], 0 to pi
};

/// @brief Relative pose error (RPE); both series have one value for each pair of times.
struct RelativeError {
  ErrorStatistics translation;  // [m]
  ErrorStatistics rotation;     // [rad]
};

/// @brief Everything that geomap-eval says of a trajectory.
struct TrajectoryMetrics {
  std::vector<PosePair> pairs;  // by time of the reference
  AbsoluteError aligned;
  AbsoluteError anchored;
  PoseDifference end;  // of the last pair, anchored
  RelativeError per_second;
  RelativeError per_metre;
};

ErrorStatistics error_statistics(std::vector<double> errors);

/// @brief Pairs of poses nearest in time, at most `max_difference` [s] apart, each pose used once,
/// the closest pair first (the benchmark's associate.py). By time of the reference.
/// @throws std::invalid_argument when `max_difference` is not between 0 and 10 s.
std::vector<PosePair> match_poses(const Trajectory& estimate, const Trajectory& reference,
                                  double max_difference);

/// @brief ATE after the rigid motion, without scale, that makes its rmse least (Horn 1987; Umeyama
/// 1991). Where the positions are on a line, or all the same, several motions do: one of them is
/// taken, and the errors are those of every other.
AbsoluteError aligned_error(const std::vector<PosePair>& pairs);

/// @brief ATE after the rigid motion that takes the first estimated pose onto the first reference
/// pose: what a robot that knows where it starts gets.
AbsoluteError anchored_error(const std::vector<PosePair>& pairs);

/// @brief RPE over one second: E = (Q_i⁻¹ Q_j)⁻¹ (P_i⁻¹ P_j), P estimate, Q reference, for each i
/// with the j whose time is nearest to t_i + 1 s. An i without a j within 0.25 s of that is left
/// out, key frames being sparse, and so is one whose second ends after the last pair, which would
/// be compared over less. Errors are not divided by the actual time.
RelativeError error_per_second(const std::vector<PosePair>& pairs);

/// @brief RPE over one metre: the same E, for each i with the first j that the reference's path,
/// straight from pair to pair, reaches after 1 m or more. Errors are not divided by its length.
RelativeError error_per_metre(const std::vector<PosePair>& pairs);

/// @brief All of the above.
/// @throws std::runtime_error, one line, when fewer than three poses match.
TrajectoryMetrics compare_trajectories(const Trajectory& estimate, const Trajectory& reference,
                                       double max_difference);

}  // namespace geomap::logs
