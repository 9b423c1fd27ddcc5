// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>

namespace geomap::logs {

/// @brief What a page was made from, for the terminal.
struct EvaluationPageSummary {
  std::size_t runs = 0;
  std::size_t missing = 0;  // files that unfinished runs lack
  std::size_t bounds = 0;   // checked
  std::size_t missed = 0;
};

/// @brief Reads a folder of runs and writes evaluation.html (one file with everything in it),
/// evaluation.md with pictures/, evaluation.json (all aggregated figures; metres, radians, seconds)
/// and benchmark.md (the tables alone) into a folder, which is made when missing.
/// @throws std::runtime_error, one line, as read_runs does, or when a file cannot be written.
EvaluationPageSummary write_evaluation_page(const std::filesystem::path& runs,
                                            const std::filesystem::path& folder);

}  // namespace geomap::logs
