// SPDX-License-Identifier: BSD-3-Clause
#include "support/program_run.hpp"

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <stdexcept>

namespace geomap::testing {

ProgramRun run_program(const std::string& command_line) {
  std::FILE* pipe = popen(("exec 2>&1; " + command_line).c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("no shell");
  ProgramRun run;
  std::array<char, 4096> buffer;
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe)) {
    run.text.append(buffer.data(), count);
  }
  const int status = pclose(pipe);
  if (WIFEXITED(status)) run.status = WEXITSTATUS(status);
  return run;
}

}  // namespace geomap::testing
