// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "logs/traffic.hpp"
#include "messaging/inbox.hpp"
#include "messaging/program.hpp"

namespace geomap::logs {

/// @brief What a text spy looks at.
struct TextSpyOptions {
  /// Channels whose whole name this regular expression matches.
  std::string channels = ".*";
  /// CHANNEL or CHANNEL.FIELD: shows what the newest message holds there.
  std::vector<std::string> fields = {};
  /// For so long, then one table [s]; else a new one every second.
  std::optional<double> once = {};
};

/// @brief The channels of a bus and the fields of some of their messages, as text. Knows neither
/// LCM nor the clock.
class TextSpy {
 public:
  /// @throws ConfigError for options that cannot be.
  explicit TextSpy(const TextSpyOptions& options);

  /// @param utime when it came, host's clock [us]
  void take(const messaging::Received& message, std::int64_t utime);
  std::string text(std::int64_t utime) const;
  bool has_heard() const { return !traffic_.channels().empty(); }

 private:
  std::string fields_text(const std::string& wanted) const;

  std::regex channels_;
  std::vector<std::string> fields_;
  std::map<std::string, messaging::Received> newest_;  // by element of fields_
  Traffic traffic_;
};

/// @brief Listens and prints until Ctrl-C, or for `once`. @return 0.
/// @throws ConfigError; std::runtime_error, one line, as Bus, or when nothing is heard in `once`.
int run_text_spy(const TextSpyOptions& options, const messaging::CommonOptions& common);

}  // namespace geomap::logs
