// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "logs/trajectory_metrics.hpp"

namespace geomap::logs {

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

/// @brief Writes evaluation.json (stable keys; metres, degrees, null where nothing could be
/// measured), evaluation.md and trajectory.svg into a folder, which is made when missing.
/// @throws std::runtime_error when a file cannot be written.
void write_evaluation(const TrajectoryEvaluation& evaluation, const std::filesystem::path& folder);

}  // namespace geomap::logs
