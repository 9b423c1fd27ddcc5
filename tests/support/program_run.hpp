// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace geomap::testing {

/// @brief What a command printed, on stdout and stderr together, and its exit status.
struct ProgramRun {
  int status = -1;  // -1: it did not end by itself
  std::string text;
};

/// @brief Runs a command line of the shell to its end.
ProgramRun run_program(const std::string& command_line);

}  // namespace geomap::testing
