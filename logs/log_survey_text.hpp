// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "logs/log_survey.hpp"

namespace geomap::logs {

/// @brief What is in the log, as a table of its channels.
std::string info_text(const LogSurvey& survey);

/// @brief Everything that is wrong with the log, a line each, and the verdict last.
std::string check_text(const LogSurvey& survey);

}  // namespace geomap::logs
