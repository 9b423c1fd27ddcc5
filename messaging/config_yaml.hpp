// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "messaging/config.hpp"

namespace geomap::messaging {

/// @brief One leaf of a YAML document.
struct YamlSetting {
  std::string key;     // dotted path
  std::string origin;  // "file.yaml:12"
  bool is_null = false;
  bool is_list = false;
  bool is_quoted = false;
  std::vector<std::string> items;  // one, unless it is a list
};

/// @brief All leaves of a YAML document, in order. @param origin its file name, for messages.
/// @throws ConfigError for text that is not YAML, no map at the top, a list of anything but
/// scalars, or a key given twice.
std::vector<YamlSetting> flatten_yaml(const std::string& text, const std::string& origin);

/// @brief The value of a leaf, its type taken from how it is written.
/// @throws ConfigError for a list with an item that is no number.
Config::Value value_of(const YamlSetting& setting);

/// @brief The value of a leaf as the type that `known` has. @throws ConfigError when it is not.
Config::Value value_like(const Config::Value& known, const YamlSetting& setting);

/// @brief A value as YAML text; numbers read back to the last bit.
std::string to_text(const Config::Value& value);

}  // namespace geomap::messaging
