// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace geomap::messaging {

struct YamlSetting;

/// @brief A wrong setting, said in one line for the person who wrote it.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// @brief All settings of all programs, in force for one run: config/default.yaml, which is part of
/// this library, overridden by a user's file, overridden by KEY=VALUE settings. Keys are dotted
/// paths, for example `merge.gap`; only those of default.yaml exist.
class Config {
 public:
  /// @brief What a setting holds. A number stays a number whether it is written 3 or 3.0.
  using Value = std::variant<bool, double, std::string, std::vector<double>>;

  /// @param file of YAML with any of the known keys.
  /// @param overrides "key=value" each, later ones win.
  /// @throws ConfigError for an unreadable file, an unknown key (the nearest known one is named),
  /// or a value of another type than the default; with file and line where there is one.
  static Config load(const std::optional<std::string>& file = std::nullopt,
                     std::span<const std::string> overrides = {});

  /// @brief The same from the text of YAML documents: `defaults` says which keys exist.
  static Config from_text(const std::string& defaults, const std::string& text,
                          const std::string& origin, std::span<const std::string> overrides = {});

  /// @brief These settings with some replaced, "key=value" each. @throws ConfigError as load().
  Config with(std::span<const std::string> overrides) const;

  /// @brief The settings of a section as the struct that uses them: default-constructed, visited,
  /// assigned, validated. @param section dotted path; empty for the top level.
  /// @throws ConfigError with all messages of Struct::validate(), for a number that is not whole
  /// where an integer is needed, or for a setting that default.yaml lacks.
  template <class Struct>
  Struct read(const std::string& section) const {
    Struct settings;
    Struct::visit(settings, [&](const std::string& name, auto& value) {
      assign(section.empty() ? name : section + "." + name, value);
    });
    check(section, settings.validate());
    return settings;
  }

  /// @brief One setting. @throws ConfigError as read().
  template <class T>
  T get(const std::string& key) const {
    T value{};
    assign(key, value);
    return value;
  }

  /// @brief All keys, in the order of default.yaml.
  std::vector<std::string> keys() const;

  /// @brief What is in force, as a file that load() accepts: `config_used.yaml` of every output.
  std::string to_yaml() const;

  /// @brief SHA-256, hexadecimal, of the values in force: equal whatever way they were given.
  std::string hash() const;

 private:
  struct Setting {
    std::string key;
    Value value;
    std::string origin;  // "file.yaml:12" or "--set"
  };

  const Setting& find(const std::string& key) const;
  template <class T>
  const T& value_as(const std::string& key, const std::string& wanted) const;
  void override_with(const YamlSetting& given);
  void override_with(const std::string& key_and_value);
  [[noreturn]] void fail_unknown(const std::string& key, const std::string& origin) const;
  void assign(const std::string& key, bool& value) const;
  void assign(const std::string& key, int& value) const;
  void assign(const std::string& key, double& value) const;
  void assign(const std::string& key, std::string& value) const;
  void assign(const std::string& key, std::vector<double>& value) const;
  void check(const std::string& section, const std::vector<std::string>& messages) const;

  std::vector<Setting> settings_;             // in the order of default.yaml
  std::map<std::string, std::size_t> index_;  // key -> settings_
};

}  // namespace geomap::messaging
