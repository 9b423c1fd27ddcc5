// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <variant>

namespace geomap::viewer {

/// @brief What the operator has set, kept between runs in a JSON file with one object of plain
/// values.
class Preferences {
 public:
  using Value = std::variant<bool, double, std::string>;

  /// @brief The stored value; `otherwise` where there is none, or one of another kind.
  bool get(const std::string& key, bool otherwise) const;
  double get(const std::string& key, double otherwise) const;
  std::string get(const std::string& key, const std::string& otherwise) const;
  void set(const std::string& key, Value value) { values_[key] = std::move(value); }
  void remove(const std::string& key) { values_.erase(key); }
  bool has(const std::string& key) const { return values_.contains(key); }

  /// @brief Of a file that is missing: none. @throws std::runtime_error, one line with the path,
  /// when it cannot be read.
  static Preferences load(const std::filesystem::path& file);
  /// @brief @throws std::runtime_error naming the path.
  void save(const std::filesystem::path& file) const;
  /// @brief $XDG_CONFIG_HOME/geomap/viewer.json, by default in ~/.config.
  static std::filesystem::path default_file();

  bool operator==(const Preferences&) const = default;

 private:
  std::map<std::string, Value> values_;
};

}  // namespace geomap::viewer
