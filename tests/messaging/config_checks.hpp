// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "messaging/config.hpp"

namespace geomap::testing {

/// @brief Compares default.yaml with the structs that read it, section by section.
///
///     ConfigChecks checks;
///     checks.expect_defaults<MergeConfig>("merge");
///     EXPECT_THAT(checks.differences(), IsEmpty());
///     EXPECT_THAT(checks.unread_keys(), IsEmpty());
class ConfigChecks {
 public:
  explicit ConfigChecks(messaging::Config config = messaging::Config::load())
      : config_(std::move(config)) {}

  /// @brief The section must hold every setting of the struct, with the default of the class.
  template <class Struct>
  void expect_defaults(const std::string& section) {
    Struct in_class;
    Struct::visit(in_class, [&](const std::string& name, auto& value) {
      const std::string key = section.empty() ? name : section + "." + name;
      read_.insert(key);
      try {
        using Setting = std::remove_reference_t<decltype(value)>;
        if (config_.get<Setting>(key) != value) {
          differences_.push_back(key + " is another than the default in its class");
        }
      } catch (const messaging::ConfigError& error) {
        differences_.push_back(error.what());
      }
    });
    for (const std::string& message : in_class.validate()) {
      differences_.push_back(section + ": the defaults are not valid: " + message);
    }
  }

  /// @brief A setting that is read by itself, without a struct.
  void expect_read(const std::string& key) { read_.insert(key); }

  const std::vector<std::string>& differences() const { return differences_; }

  /// @brief Keys of default.yaml that nobody reads.
  std::vector<std::string> unread_keys() const {
    std::vector<std::string> unread;
    for (const std::string& key : config_.keys()) {
      if (!read_.contains(key)) unread.push_back(key);
    }
    return unread;
  }

 private:
  messaging::Config config_;
  std::set<std::string> read_;
  std::vector<std::string> differences_;
};

}  // namespace geomap::testing
