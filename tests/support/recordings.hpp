// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace geomap::testing {

/// @brief A folder or file of the recorded data (`GEOMAP_DATA`), or nothing where it is missing.
std::optional<std::filesystem::path> recording(const std::string& name);

}  // namespace geomap::testing

/// Skips the current test, with the reason printed, where a recording is missing.
#define GEOMAP_REQUIRE_RECORDING(variable, name)                                              \
  const auto variable##_found = ::geomap::testing::recording(name);                           \
  if (!variable##_found) GTEST_SKIP() << "no recording '" << (name) << "' under GEOMAP_DATA"; \
  const std::filesystem::path variable = *variable##_found
