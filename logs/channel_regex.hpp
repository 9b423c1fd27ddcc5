// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <regex>
#include <string>

namespace geomap::logs {

/// @brief A regular expression for names of channels. @throws ConfigError that names the option
/// when the text is none.
std::regex channel_regex(const std::string& option, const std::string& text);

}  // namespace geomap::logs
