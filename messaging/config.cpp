// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/config.hpp"

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <numeric>
#include <sstream>

#include "messaging/config_yaml.hpp"
#include "messaging/embedded_text.hpp"

namespace geomap::messaging {
namespace {

/// Levenshtein's edit distance.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

/// People also forget the section: a key may be near a known one's last part.
std::size_t distance(const std::string& given, const std::string& known) {
  const std::string last_part = known.substr(known.rfind('.') + 1);
  return std::min(edit_distance(given, known), edit_distance(given, last_part) + 1);
}

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file) text << file.rdbuf();
  if (!file || !text) throw ConfigError("cannot read config file '" + path + "'");
  return text.str();
}

std::vector<std::string> split_path(const std::string& key) {
  std::vector<std::string> parts;
  std::istringstream stream(key);
  for (std::string part; std::getline(stream, part, '.');) parts.push_back(part);
  return parts;
}

/// The items of "1, 2, 3" or "[1, 2, 3]".
std::vector<std::string> split_list(std::string text) {
  std::erase_if(text, [](char c) { return c == '[' || c == ']' || c == ' '; });
  std::vector<std::string> items;
  std::istringstream stream(text);
  for (std::string item; std::getline(stream, item, ',');) items.push_back(item);
  return items;
}

std::string sha256_hex(const std::string& text) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  if (EVP_Digest(text.data(), text.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1) {
    throw std::runtime_error("SHA-256 is not available");
  }
  constexpr const char* kDigits = "0123456789abcdef";
  std::string hex;
  for (unsigned int i = 0; i < size; ++i) {
    hex += kDigits[digest[i] >> 4];
    hex += kDigits[digest[i] & 15];
  }
  return hex;
}

}  // namespace

Config Config::load(const std::optional<std::string>& file,
                    std::span<const std::string> overrides) {
  return from_text(kDefaultYaml, file ? read_file(*file) : "", file.value_or(""), overrides);
}

Config Config::from_text(const std::string& defaults, const std::string& text,
                         const std::string& origin, std::span<const std::string> overrides) {
  Config config;
  for (const YamlSetting& setting : flatten_yaml(defaults, "default.yaml")) {
    config.index_.emplace(setting.key, config.settings_.size());
    config.settings_.push_back({setting.key, value_of(setting), setting.origin});
  }
  for (const YamlSetting& setting : flatten_yaml(text, origin)) config.override_with(setting);
  for (const std::string& key_and_value : overrides) config.override_with(key_and_value);
  return config;
}

Config Config::with(std::span<const std::string> overrides) const {
  Config config = *this;
  for (const std::string& key_and_value : overrides) config.override_with(key_and_value);
  return config;
}

void Config::override_with(const YamlSetting& given) {
  const auto known = index_.find(given.key);
  if (known == index_.end()) {
    const bool is_section = std::any_of(settings_.begin(), settings_.end(), [&](const Setting& s) {
      return s.key.starts_with(given.key + ".");
    });
    if (is_section && given.is_null) return;  // a section left empty
    if (is_section) {
      throw ConfigError("'" + given.key + "' (" + given.origin + ") is a section, not a setting");
    }
    fail_unknown(given.key, given.origin);
  }
  Setting& setting = settings_[known->second];
  setting.value = value_like(setting.value, given);
  setting.origin = given.origin;
}

void Config::override_with(const std::string& key_and_value) {
  const std::size_t equals = key_and_value.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw ConfigError("--set needs KEY=VALUE, not '" + key_and_value + "'");
  }
  YamlSetting given{key_and_value.substr(0, equals),   "--set", false, false, false,
                    {key_and_value.substr(equals + 1)}};
  const auto known = index_.find(given.key);
  if (known != index_.end() &&
      std::holds_alternative<std::vector<double>>(settings_[known->second].value)) {
    given.is_list = true;
    given.items = split_list(given.items.front());
  }
  override_with(given);
}

void Config::fail_unknown(const std::string& key, const std::string& origin) const {
  const auto nearest =
      std::min_element(settings_.begin(), settings_.end(), [&](const Setting& a, const Setting& b) {
        return distance(key, a.key) < distance(key, b.key);
      });
  std::string text = "unknown setting '" + key + "' (" + origin + ")";
  if (nearest != settings_.end()) text += "; the nearest known one is '" + nearest->key + "'";
  throw ConfigError(text);
}

const Config::Setting& Config::find(const std::string& key) const {
  const auto known = index_.find(key);
  if (known == index_.end()) fail_unknown(key, "asked for by the program");
  return settings_[known->second];
}

template <class T>
const T& Config::value_as(const std::string& key, const std::string& wanted) const {
  const Setting& setting = find(key);
  if (const T* value = std::get_if<T>(&setting.value)) return *value;
  throw ConfigError("setting '" + key + "' (" + setting.origin + ") must be " + wanted + ", not '" +
                    to_text(setting.value) + "'");
}

void Config::assign(const std::string& key, bool& value) const {
  value = value_as<bool>(key, "true or false");
}

void Config::assign(const std::string& key, int& value) const {
  const double number = value_as<double>(key, "a whole number");
  if (number != std::round(number) || std::abs(number) > std::numeric_limits<int>::max()) {
    throw ConfigError("setting '" + key + "' (" + find(key).origin +
                      ") must be a whole number, not '" + to_text(Value(number)) + "'");
  }
  value = static_cast<int>(number);
}

void Config::assign(const std::string& key, double& value) const {
  value = value_as<double>(key, "a number");
}

void Config::assign(const std::string& key, std::string& value) const {
  value = value_as<std::string>(key, "a text");
}

void Config::assign(const std::string& key, std::vector<double>& value) const {
  value = value_as<std::vector<double>>(key, "a list of numbers");
}

void Config::check(const std::string& section, const std::vector<std::string>& messages) const {
  if (messages.empty()) return;
  std::string text = "settings of '" + section + "': ";
  for (std::size_t i = 0; i < messages.size(); ++i) text += (i > 0 ? "; " : "") + messages[i];
  throw ConfigError(text);
}

std::vector<std::string> Config::keys() const {
  std::vector<std::string> keys;
  for (const Setting& setting : settings_) keys.push_back(setting.key);
  return keys;
}

std::string Config::to_yaml() const {
  std::string text;
  std::vector<std::string> open;  // sections around the last setting
  for (const Setting& setting : settings_) {
    const std::vector<std::string> path = split_path(setting.key);
    std::size_t depth = 0;
    while (depth < open.size() && depth + 1 < path.size() && open[depth] == path[depth]) ++depth;
    open.resize(depth);
    for (; depth + 1 < path.size(); ++depth) {
      text += std::string(2 * depth, ' ') + path[depth] + ":\n";
      open.push_back(path[depth]);
    }
    text += std::string(2 * depth, ' ') + path.back() + ": " + to_text(setting.value) + "\n";
  }
  return text;
}

std::string Config::hash() const {
  std::string text;
  for (const Setting& setting : settings_)
    text += setting.key + "=" + to_text(setting.value) + "\n";
  return sha256_hex(text);
}

}  // namespace geomap::messaging
