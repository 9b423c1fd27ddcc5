// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace geomap::testing {

/// @brief Checks the sources below `root` against the project's rules on who includes what (see
/// CONTRIBUTING.md), and each file's SPDX line and `#pragma once`.
/// @return one line for each breach, "FILE:LINE: what is wrong", ordered by file; none when all is
/// well.
std::vector<std::string> architecture_breaches(const std::filesystem::path& root);

}  // namespace geomap::testing
