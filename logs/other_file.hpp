// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <system_error>

#include "messaging/config.hpp"

namespace geomap::logs {

/// @brief Results must not replace what they are made from.
/// @throws messaging::ConfigError when both paths name one file.
inline void require_other_file(const std::filesystem::path& log, const std::filesystem::path& out) {
  std::error_code ignored;  // files that do not exist are not the same
  if (std::filesystem::equivalent(log, out, ignored)) {
    throw messaging::ConfigError(out.string() + " is the log to read: choose another name");
  }
}

}  // namespace geomap::logs
