// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "logs/map_evaluation_run.hpp"

namespace geomap::logs {

/// @brief The headline figures in a few lines, for the terminal.
std::string summary_text(const MapEvaluationRun& run);

/// @brief All figures as Markdown tables; against a truth, the paper's beside ours.
std::string report_text(const MapEvaluationRun& run);

}  // namespace geomap::logs
