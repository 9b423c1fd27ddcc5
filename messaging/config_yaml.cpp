// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/config_yaml.hpp"

#include <yaml-cpp/yaml.h>

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>

namespace geomap::messaging {
namespace {

std::string at_line(const std::string& origin, const YAML::Mark& mark) {
  return mark.is_null() ? origin : origin + ":" + std::to_string(mark.line + 1);
}

std::optional<double> to_number(const std::string& text) {
  double value = 0.0;
  const char* first = text.data();
  const char* last = first + text.size();
  if (text.size() > 1 && *first == '+') ++first;
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc() || end != last || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string to_text(double value) {
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end};
}

class Flattener {
 public:
  explicit Flattener(const std::string& origin) : origin_(origin) {}

  void add_map(const YAML::Node& map, const std::string& prefix) {
    for (const auto& entry : map) {
      const std::string key = prefix + entry.first.as<std::string>();
      const std::string origin = at_line(origin_, entry.first.Mark());
      if (entry.second.IsMap()) {
        add_map(entry.second, key + ".");
      } else {
        if (!seen_.insert(key).second) {
          throw ConfigError("setting '" + key + "' (" + origin + ") is given twice");
        }
        settings_.push_back(leaf(key, origin, entry.second));
      }
    }
  }

  std::vector<YamlSetting> take() { return std::move(settings_); }

 private:
  static YamlSetting leaf(const std::string& key, const std::string& origin,
                          const YAML::Node& node) {
    YamlSetting setting{key, origin, node.IsNull(), node.IsSequence(), node.Tag() == "!", {}};
    if (node.IsScalar()) setting.items.push_back(node.Scalar());
    for (const YAML::Node& item : node) {
      if (!item.IsScalar()) {
        throw ConfigError("setting '" + key + "' (" + origin + ") must be a list of numbers");
      }
      setting.items.push_back(item.Scalar());
    }
    return setting;
  }

  std::string origin_;
  std::vector<YamlSetting> settings_;
  std::set<std::string> seen_;
};

std::vector<double> to_numbers(const YamlSetting& setting) {
  std::vector<double> numbers;
  for (const std::string& item : setting.items) {
    const std::optional<double> number = to_number(item);
    if (!number) {
      throw ConfigError("setting '" + setting.key + "' (" + setting.origin +
                        ") must be a list of numbers, '" + item + "' is none");
    }
    numbers.push_back(*number);
  }
  return numbers;
}

[[noreturn]] void fail_type(const YamlSetting& setting, const std::string& wanted) {
  const std::string given = setting.is_list ? "a list" : "'" + setting.items.front() + "'";
  throw ConfigError("setting '" + setting.key + "' (" + setting.origin + ") must be " + wanted +
                    ", not " + given);
}

}  // namespace

std::vector<YamlSetting> flatten_yaml(const std::string& text, const std::string& origin) {
  try {
    const YAML::Node root = YAML::Load(text);
    if (root.IsNull()) return {};
    if (!root.IsMap()) throw ConfigError("'" + origin + "' holds no KEY: VALUE lines");
    Flattener flattener(origin);
    flattener.add_map(root, "");
    return flattener.take();
  } catch (const YAML::Exception& error) {
    throw ConfigError("'" + at_line(origin, error.mark) + "' is not YAML: " + error.msg);
  }
}

Config::Value value_of(const YamlSetting& setting) {
  if (setting.is_list) return to_numbers(setting);
  if (setting.is_null) return std::string();
  const std::string& text = setting.items.front();
  if (setting.is_quoted) return text;
  if (text == "true" || text == "false") return text == "true";
  if (const std::optional<double> number = to_number(text)) return *number;
  return text;
}

Config::Value value_like(const Config::Value& known, const YamlSetting& setting) {
  if (setting.is_null) {
    throw ConfigError("setting '" + setting.key + "' (" + setting.origin + ") has no value");
  }
  if (std::holds_alternative<std::vector<double>>(known)) {
    if (!setting.is_list) fail_type(setting, "a list of numbers");
    return to_numbers(setting);
  }
  if (std::holds_alternative<std::string>(known)) {
    if (setting.is_list) fail_type(setting, "a text");
    return setting.items.front();
  }
  const Config::Value value = value_of(setting);
  if (value.index() != known.index()) {
    fail_type(setting, std::holds_alternative<bool>(known) ? "true or false" : "a number");
  }
  return value;
}

std::string to_text(const Config::Value& value) {
  if (const bool* boolean = std::get_if<bool>(&value)) return *boolean ? "true" : "false";
  if (const double* number = std::get_if<double>(&value)) return to_text(*number);
  if (const auto* numbers = std::get_if<std::vector<double>>(&value)) {
    std::string text = "[";
    for (const double number : *numbers) text += (text.size() > 1 ? ", " : "") + to_text(number);
    return text + "]";
  }
  YAML::Emitter emitter;
  emitter << std::get<std::string>(value);
  return emitter.c_str();
}

}  // namespace geomap::messaging
