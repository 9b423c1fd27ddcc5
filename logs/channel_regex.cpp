// SPDX-License-Identifier: BSD-3-Clause
#include "logs/channel_regex.hpp"

#include "messaging/config.hpp"

namespace geomap::logs {

std::regex channel_regex(const std::string& option, const std::string& text) {
  try {
    return std::regex(text);
  } catch (const std::regex_error&) {
    throw messaging::ConfigError(option + ": '" + text + "' is no regular expression");
  }
}

}  // namespace geomap::logs
