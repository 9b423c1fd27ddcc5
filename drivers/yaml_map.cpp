// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/yaml_map.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <utility>

#include "drivers/frame_source.hpp"
#include "drivers/input_file.hpp"

namespace geomap::drivers {
namespace {

std::string place(const std::filesystem::path& file, const YAML::Mark& mark) {
  return file.string() + ":" + std::to_string(mark.is_null() ? 1 : mark.line + 1);
}

std::string in_quotes(std::string_view text) {
  std::string result = "'";
  result += text;
  return result += "'";
}

std::optional<double> finite(const YAML::Node& node) {
  // Unlike yaml-cpp's own conversion, whatever the locale.
  double value = 0.0;
  const std::string text = node.IsScalar() ? node.Scalar() : std::string();
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  const bool is_number = error == std::errc() && stopped == end && std::isfinite(value);
  return is_number ? std::optional(value) : std::nullopt;
}

std::optional<Eigen::Vector3d> finite_vector(const YAML::Node& node) {
  if (!node.IsSequence() || node.size() != 3) return std::nullopt;
  Eigen::Vector3d result;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto value = finite(node[i]);
    if (!value) return std::nullopt;
    result[static_cast<Eigen::Index>(i)] = *value;
  }
  return result;
}

std::optional<std::vector<Eigen::Vector3d>> finite_points(const YAML::Node& node) {
  if (!node.IsSequence()) return std::nullopt;
  std::vector<Eigen::Vector3d> points;
  for (const YAML::Node& item : node) {
    const auto point = finite_vector(item);
    if (!point) return std::nullopt;
    points.push_back(*point);
  }
  return points;
}

}  // namespace

YamlMap::YamlMap(std::filesystem::path file, const YAML::Node& node)
    : file_(std::move(file)), node_(std::make_shared<const YAML::Node>(node)) {
  if (!node.IsMap()) fail("expected KEY: VALUE pairs");
}

YamlMap YamlMap::load(const std::filesystem::path& file) {
  const std::vector<std::uint8_t> bytes = read_bytes(file);
  try {
    return {file, YAML::Load(std::string(bytes.begin(), bytes.end()))};
  } catch (const YAML::Exception& error) {
    throw SourceError(place(file, error.mark) + ": not YAML: " + error.msg);
  }
}

bool YamlMap::has(std::string_view key) const { return (*node_)[std::string(key)].IsDefined(); }

YAML::Node YamlMap::get(std::string_view key) const {
  const YAML::Node node = (*node_)[std::string(key)];
  if (!node.IsDefined()) fail(in_quotes(key) + " is missing");
  return node;
}

double YamlMap::number(std::string_view key, std::optional<double> fallback) const {
  if (fallback && !has(key)) return *fallback;
  const auto value = finite(get(key));
  if (!value) fail(key, "must be a number");
  return *value;
}

double YamlMap::positive(std::string_view key, std::optional<double> fallback) const {
  const double value = number(key, fallback);
  if (value <= 0.0) fail(key, "must be above 0");
  return value;
}

bool YamlMap::boolean(std::string_view key, std::optional<bool> fallback) const {
  if (fallback && !has(key)) return *fallback;
  bool value = false;
  const YAML::Node node = get(key);
  if (!node.IsScalar() || !YAML::convert<bool>::decode(node, value)) {
    fail(key, "must be true or false");
  }
  return value;
}

std::string YamlMap::text(std::string_view key, const std::optional<std::string>& fallback) const {
  if (fallback && !has(key)) return *fallback;
  const YAML::Node node = get(key);
  if (!node.IsScalar()) fail(key, "must be a text");
  return node.Scalar();
}

std::vector<double> YamlMap::numbers(std::string_view key, std::size_t count) const {
  const YAML::Node node = get(key);
  std::vector<double> values;
  if (node.IsSequence()) {
    for (const YAML::Node& item : node) {
      if (const auto value = finite(item)) values.push_back(*value);
    }
  }
  if (values.size() != count || node.size() != count) {
    fail(key, "must be a list of " + std::to_string(count) + " numbers");
  }
  return values;
}

Eigen::Vector3d YamlMap::vector(std::string_view key,
                                const std::optional<Eigen::Vector3d>& fallback) const {
  if (fallback && !has(key)) return *fallback;
  const std::vector<double> values = numbers(key, 3);
  return {values[0], values[1], values[2]};
}

std::vector<Eigen::Vector3d> YamlMap::points(std::string_view key) const {
  const auto points = finite_points(get(key));
  if (!points) fail(key, "must be a list of [x, y, z]");
  return *points;
}

std::vector<std::vector<Eigen::Vector3d>> YamlMap::point_lists(std::string_view key) const {
  std::vector<std::vector<Eigen::Vector3d>> lists;
  if (!has(key)) return lists;
  const YAML::Node node = get(key);
  if (!node.IsSequence()) fail(key, "must be a list");
  for (const YAML::Node& item : node) {
    const auto points = finite_points(item);
    if (!points) fail(key, "must hold lists of [x, y, z]");
    lists.push_back(*points);
  }
  return lists;
}

YamlMap YamlMap::map(std::string_view key) const { return {file_, get(key)}; }

std::vector<YamlMap> YamlMap::maps(std::string_view key) const {
  std::vector<YamlMap> result;
  if (!has(key)) return result;
  const YAML::Node node = get(key);
  if (!node.IsSequence()) fail(key, "must be a list");
  for (const YAML::Node& item : node) result.push_back(YamlMap(file_, item));
  return result;
}

void YamlMap::allow_only(std::initializer_list<std::string_view> keys) const {
  std::set<std::string> seen;
  for (const auto& entry : *node_) {
    const auto key = entry.first.as<std::string>();
    if (!seen.insert(key).second) fail(key, "is given twice");
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    std::string known;
    for (const std::string_view k : keys) known += (known.empty() ? "" : ", ") + std::string(k);
    throw SourceError(place(file_, entry.first.Mark()) + ": unknown key " + in_quotes(key) +
                      "; known here: " + known);
  }
}

void YamlMap::fail(const std::string& what) const {
  throw SourceError(place(file_, node_->Mark()) + ": " + what);
}

void YamlMap::fail(std::string_view key, const std::string& what) const {
  const YAML::Node node = (*node_)[std::string(key)];
  throw SourceError(place(file_, node.Mark()) + ": " + in_quotes(key) + " " + what);
}

}  // namespace geomap::drivers
