// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/preferences.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "mapping/export_file.hpp"

namespace geomap::viewer {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
T value_or(const std::map<std::string, Preferences::Value>& values, const std::string& key,
           const T& otherwise) {
  const auto found = values.find(key);
  if (found == values.end()) return otherwise;
  const T* value = std::get_if<T>(&found->second);
  return value ? *value : otherwise;
}

}  // namespace

bool Preferences::get(const std::string& key, bool otherwise) const {
  return value_or(values_, key, otherwise);
}
double Preferences::get(const std::string& key, double otherwise) const {
  return value_or(values_, key, otherwise);
}
std::string Preferences::get(const std::string& key, const std::string& otherwise) const {
  return value_or(values_, key, otherwise);
}

Preferences Preferences::load(const std::filesystem::path& file) {
  Preferences preferences;
  if (!std::filesystem::exists(file)) return preferences;
  std::ifstream in(file);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  const Json json = Json::parse(text, nullptr, false);
  if (!in || !json.is_object()) {
    throw std::runtime_error(file.string() +
                             ": no preferences can be read from it; delete it to begin anew");
  }
  for (const auto& [key, value] : json.items()) {
    if (value.is_boolean()) preferences.set(key, value.get<bool>());
    if (value.is_number()) preferences.set(key, value.get<double>());
    if (value.is_string()) preferences.set(key, value.get<std::string>());
  }
  return preferences;
}

void Preferences::save(const std::filesystem::path& file) const {
  Json json = Json::object();
  for (const auto& [key, value] : values_) {
    std::visit([&](const auto& plain) { json[key] = plain; }, value);
  }
  std::error_code ignored;  // writing says it better
  std::filesystem::create_directories(file.parent_path(), ignored);
  mapping::write_file(file, json.dump(1) + "\n");
}

std::filesystem::path Preferences::default_file() {
  const char* config = std::getenv("XDG_CONFIG_HOME");
  const char* home = std::getenv("HOME");
  const std::filesystem::path folder = config && *config ? std::filesystem::path(config)
                                       : home            ? std::filesystem::path(home) / ".config"
                                                         : std::filesystem::path(".");
  return folder / "geomap" / "viewer.json";
}

}  // namespace geomap::viewer
