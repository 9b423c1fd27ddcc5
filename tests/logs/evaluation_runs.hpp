// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "logs/evaluation_page.hpp"
#include "messaging/temporary_folder.hpp"

namespace geomap::testing {

/// @brief What a run's files have otherwise: JSON merge patches, so that null takes a key away.
struct RunChanges {
  std::string evaluation = "{}";
  std::string report = "{}";
};

/// @brief Writes a finished run SET/VARIANT/SEED: evaluation.json of a map with one error
/// throughout, report.json of a replay of four key frames with five planes in each, and a small
/// map.svg.
/// @param error d_angle [rad]; d_coeff is twice, d_dist three times, d_dist_local and rms_p twice
/// as much [m].
void write_run(const std::filesystem::path& run, double error, const RunChanges& changes = {});

/// @brief Of a Markdown file the line that begins with `begin`, after a line with `after`.
std::string line_after(const std::string& text, const std::string& after, const std::string& begin);

/// @brief A folder of runs and one for the page that is made of them.
class RunsFolder : public TemporaryFolder {
 protected:
  std::filesystem::path run(const std::string& name) const {
    return std::filesystem::path(path("runs")) / name;
  }
  logs::EvaluationPageSummary write() const {
    return logs::write_evaluation_page(path("runs"), path("out"));
  }
  std::string written(const std::string& name) const { return read_file(path("out/" + name)); }

  /// Two seeds of every set of the paper's Table 1, for both ways to merge: d_angle is 0.0008 and
  /// 0.0010 by moments, 0.008 by the paper's equations.
  void write_paper_sets() const;
};

}  // namespace geomap::testing
