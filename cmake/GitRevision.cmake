# SPDX-License-Identifier: BSD-3-Clause
# Run at every build: writes OUTPUT with the revision of SOURCE_DIR, only when it changed.
execute_process(COMMAND git -C ${SOURCE_DIR} describe --always --dirty --abbrev=12
                OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT revision)
  set(revision unknown)
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT [[
// SPDX-License-Identifier: BSD-3-Clause
#include "logs/git_revision.hpp"

namespace geomap::logs {
const char* const kGitRevision = "@revision@";
}
]] @ONLY)
