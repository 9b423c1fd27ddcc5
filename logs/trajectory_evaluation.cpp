// SPDX-License-Identifier: BSD-3-Clause
#include "logs/trajectory_evaluation.hpp"

#include <fmt/format.h>

#include "geometry/angles.hpp"
#include "logs/trajectory_plot.hpp"
#include "mapping/export_features.hpp"

namespace geomap::logs {
namespace {

using geometry::degrees;

std::string name_of(const std::string& file) {
  return mapping::clean_text(std::filesystem::path(file).filename().string());
}

std::string absolute_table(const TrajectoryMetrics& metrics) {
  std::string text =
      "| distance from the reference [cm] | rmse | mean | median | max | std |\n"
      "|---|--:|--:|--:|--:|--:|\n";
  const auto row = [&](const char* name, const ErrorStatistics& s) {
    text += fmt::format("| {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n", name, 100 * s.rmse,
                        100 * s.mean, 100 * s.median, 100 * s.max, 100 * s.deviation);
  };
  row("aligned as a whole", metrics.aligned.statistics);
  row("anchored at the first pose", metrics.anchored.statistics);
  return text;
}

std::string relative_table(const TrajectoryMetrics& metrics) {
  std::string text =
      "| relative error | pairs | rmse [cm] | median [cm] | max [cm] | rmse [°] | median [°] | max "
      "[°] |\n|---|--:|--:|--:|--:|--:|--:|--:|\n";
  const auto row = [&](const char* name, const RelativeError& error) {
    const ErrorStatistics& t = error.translation;
    const ErrorStatistics r = in_degrees(error.rotation);
    if (t.count == 0) {
      text += fmt::format("| {} | 0 | - | - | - | - | - | - |\n", name);
      return;
    }
    text +=
        fmt::format("| {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.3f} | {:.3f} | {:.3f} |\n", name,
                    t.count, 100 * t.rmse, 100 * t.median, 100 * t.max, r.rmse, r.median, r.max);
  };
  row("over one second", metrics.per_second);
  row("over one metre", metrics.per_metre);
  return text;
}

std::string relative_line(const char* name, const RelativeError& error) {
  if (error.translation.count == 0) return fmt::format("RPE {}: no such pairs of poses\n", name);
  return fmt::format("RPE {}: rmse {:.2f} cm and {:.3f}° over {} pairs\n", name,
                     100 * error.translation.rmse, degrees(error.rotation.rmse),
                     error.translation.count);
}

}  // namespace

ErrorStatistics in_degrees(ErrorStatistics statistics) {
  for (double* value : {&statistics.rmse, &statistics.mean, &statistics.median, &statistics.max,
                        &statistics.deviation}) {
    *value = degrees(*value);
  }
  return statistics;
}

TrajectoryEvaluation evaluate_trajectory(const std::filesystem::path& trajectory,
                                         const std::filesystem::path& reference,
                                         double max_difference) {
  const Trajectory estimated = read_trajectory(trajectory);
  const Trajectory truth = read_trajectory(reference);
  TrajectoryEvaluation evaluation;
  evaluation.trajectory = trajectory.string();
  evaluation.reference = reference.string();
  evaluation.trajectory_poses = estimated.size();
  evaluation.reference_poses = truth.size();
  evaluation.max_difference = max_difference;
  evaluation.metrics = compare_trajectories(estimated, truth, max_difference);
  evaluation.picture =
      trajectory_svg(evaluation.metrics, truth,
                     name_of(evaluation.trajectory) + " against " + name_of(evaluation.reference));
  return evaluation;
}

std::string report_text(const TrajectoryEvaluation& evaluation) {
  const TrajectoryMetrics& metrics = evaluation.metrics;
  return fmt::format(
      "# Trajectory {} against {}\n\n![Both trajectories from above and from the side, and their "
      "distance over time]({})\n\n{} of {} poses match one of the reference's {} within {} s.\n\n"
      "## Absolute error\n\n{}\nAligned: after the rigid motion, without scale, that makes the "
      "rmse "
      "least. Anchored: after the one that takes the first pose onto the reference's; the last "
      "pose "
      "is then {:.2f} cm and {:.3f}° away.\n\n## Relative error\n\n{}\nBetween poses a second "
      "apart, "
      "and between poses a metre of the reference's path apart, as the TUM RGB-D benchmark defines "
      "it.\n",
      name_of(evaluation.trajectory), name_of(evaluation.reference), kTrajectoryPicture,
      metrics.pairs.size(), evaluation.trajectory_poses, evaluation.reference_poses,
      evaluation.max_difference, absolute_table(metrics), 100 * metrics.end.translation,
      degrees(metrics.end.rotation), relative_table(metrics));
}

std::string summary_text(const TrajectoryEvaluation& evaluation) {
  const TrajectoryMetrics& metrics = evaluation.metrics;
  const auto ate = [](const char* name, const ErrorStatistics& s) {
    return fmt::format("ATE {}: rmse {:.2f} cm, median {:.2f} cm, max {:.2f} cm\n", name,
                       100 * s.rmse, 100 * s.median, 100 * s.max);
  };
  return fmt::format("{} of {} poses matched\n", metrics.pairs.size(),
                     evaluation.trajectory_poses) +
         ate("aligned", metrics.aligned.statistics) + ate("anchored", metrics.anchored.statistics) +
         relative_line("per second", metrics.per_second) +
         relative_line("per metre", metrics.per_metre);
}

}  // namespace geomap::logs
