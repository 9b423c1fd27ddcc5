// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "logs/map_evaluation_run.hpp"
#include "logs/trajectory_evaluation.hpp"

namespace geomap::logs {

/// @brief What geomap-eval shall compare; an empty name was not given.
struct EvaluationOptions {
  MapEvaluationFiles map{};
  std::string trajectory{};      // TUM files
  std::string reference{};       // of the trajectory
  double max_difference = 0.02;  // between matched times of the trajectories [s]
};

/// @brief A result compared with what is known: of a map, of a trajectory, or of both.
struct Evaluation {
  std::optional<MapEvaluationRun> map;
  std::optional<TrajectoryEvaluation> trajectory;
};

/// @brief What is wrong with a choice of files, in one line; empty for one that makes sense.
std::string usage_fault(const EvaluationOptions& options);

/// @brief Reads the files and compares them.
/// @throws std::invalid_argument for options with a usage_fault; std::runtime_error, one line, when
/// a file cannot be used or too few poses match.
Evaluation evaluate(const EvaluationOptions& options);

/// @brief The headline figures in a few lines, for the terminal.
std::string summary_text(const Evaluation& evaluation);

/// @brief Writes evaluation.json (see evaluation_json), evaluation.md and, for a trajectory,
/// trajectory.svg into a folder, which is made when missing.
/// @throws std::runtime_error when a file cannot be written.
void write_evaluation(const Evaluation& evaluation, const std::filesystem::path& folder);

}  // namespace geomap::logs
