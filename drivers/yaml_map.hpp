// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace YAML {
class Node;
}

namespace geomap::drivers {

/// @brief A map of a YAML file that a person wrote: every fault becomes a SourceError of one line
/// that begins with FILE:LINE.
class YamlMap {
 public:
  /// @brief The map at the top of a file.
  static YamlMap load(const std::filesystem::path& file);

  bool has(std::string_view key) const;

  /// @brief A finite number. Without `fallback` the key must be there.
  double number(std::string_view key, std::optional<double> fallback = {}) const;
  double positive(std::string_view key, std::optional<double> fallback = {}) const;
  bool boolean(std::string_view key, std::optional<bool> fallback = {}) const;
  std::string text(std::string_view key, const std::optional<std::string>& fallback = {}) const;
  /// @brief Exactly `count` finite numbers.
  std::vector<double> numbers(std::string_view key, std::size_t count) const;
  Eigen::Vector3d vector(std::string_view key,
                         const std::optional<Eigen::Vector3d>& fallback = {}) const;
  /// @brief A list of [x, y, z].
  std::vector<Eigen::Vector3d> points(std::string_view key) const;
  /// @brief A list of such lists; none where the key is missing.
  std::vector<std::vector<Eigen::Vector3d>> point_lists(std::string_view key) const;
  YamlMap map(std::string_view key) const;
  /// @brief A list of maps; none where the key is missing.
  std::vector<YamlMap> maps(std::string_view key) const;

  /// @brief Refuses every key but these, naming them.
  void allow_only(std::initializer_list<std::string_view> keys) const;

  [[noreturn]] void fail(const std::string& what) const;
  [[noreturn]] void fail(std::string_view key, const std::string& what) const;

 private:
  YamlMap(std::filesystem::path file, const YAML::Node& node);
  YAML::Node get(std::string_view key) const;

  std::filesystem::path file_;
  std::shared_ptr<const YAML::Node> node_;
};

}  // namespace geomap::drivers
