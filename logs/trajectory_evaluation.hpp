// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "logs/trajectory_metrics.hpp"

namespace geomap::logs {

/// @brief File name of the picture.
inline constexpr const char* kTrajectoryPicture = "trajectory.svg";

/// @brief A trajectory compared with a reference, and the picture of it.
struct TrajectoryEvaluation {
  std::string trajectory;  // files, as they were named
  std::string reference;
  std::size_t trajectory_poses = 0;
  std::size_t reference_poses = 0;
  double max_difference = 0.0;  // between matched times [s]
  TrajectoryMetrics metrics;
  std::string picture;  // SVG
};

/// @brief Reads two TUM files and compares them.
/// @param max_difference between matched times [s].
/// @throws std::runtime_error, one line, when a file cannot be used or too few poses match.
TrajectoryEvaluation evaluate_trajectory(const std::filesystem::path& trajectory,
                                         const std::filesystem::path& reference,
                                         double max_difference);

/// @brief ATE and RPE in a few lines, for the terminal.
std::string summary_text(const TrajectoryEvaluation& evaluation);

/// @brief The same and more as Markdown, with the picture as kTrajectoryPicture beside it.
std::string report_text(const TrajectoryEvaluation& evaluation);

/// @brief Radians into degrees.
ErrorStatistics in_degrees(ErrorStatistics statistics);

}  // namespace geomap::logs
