// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace geomap::logs {

/// @brief The commit this program was built from, "-dirty" behind it when files had changed.
extern const char* const kGitRevision;

}  // namespace geomap::logs
