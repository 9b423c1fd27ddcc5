// SPDX-License-Identifier: BSD-3-Clause
#include "logs/evaluation.hpp"

#include <stdexcept>

#include "logs/evaluation_json.hpp"
#include "logs/map_evaluation_text.hpp"
#include "mapping/export_file.hpp"

namespace geomap::logs {

std::string usage_fault(const EvaluationOptions& options) {
  const MapEvaluationFiles& map = options.map;
  if (map.map.empty()) {
    for (const auto& [name, value] :
         {std::pair{"--truth", map.truth}, {"--against", map.against}, {"--report", map.report}}) {
      if (!value.empty()) return std::string(name) + " needs --map";
    }
  } else {
    if (!map.truth.empty() && !map.against.empty()) return "--truth excludes --against";
    if (map.truth.empty() && map.against.empty()) return "--map needs --truth or --against";
  }
  if (options.trajectory.empty() != options.reference.empty()) {
    return options.trajectory.empty() ? "--reference needs --trajectory"
                                      : "--trajectory needs --reference";
  }
  if (map.map.empty() && options.trajectory.empty()) {
    return "nothing to evaluate: give --map with --truth or --against, or --trajectory with "
           "--reference";
  }
  return "";
}

Evaluation evaluate(const EvaluationOptions& options) {
  if (const std::string fault = usage_fault(options); !fault.empty()) {
    throw std::invalid_argument(fault);
  }
  Evaluation evaluation;
  if (!options.map.map.empty()) evaluation.map = evaluate_map_files(options.map);
  if (!options.trajectory.empty()) {
    evaluation.trajectory =
        evaluate_trajectory(options.trajectory, options.reference, options.max_difference);
  }
  return evaluation;
}

std::string summary_text(const Evaluation& evaluation) {
  std::string text;
  if (evaluation.map) text += summary_text(*evaluation.map);
  if (evaluation.trajectory) text += summary_text(*evaluation.trajectory);
  return text;
}

void write_evaluation(const Evaluation& evaluation, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::string report;
  if (evaluation.map) report += report_text(*evaluation.map);
  if (evaluation.trajectory) {
    if (!report.empty()) report += "\n";
    report += report_text(*evaluation.trajectory);
    mapping::write_file(folder / kTrajectoryPicture, evaluation.trajectory->picture);
  }
  mapping::write_file(folder / "evaluation.md", report);
  mapping::write_file(folder / "evaluation.json", evaluation_json(evaluation));
}

}  // namespace geomap::logs
