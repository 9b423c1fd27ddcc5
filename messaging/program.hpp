// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "messaging/config.hpp"

namespace CLI {
class App;
}

namespace geomap::messaging {

/// @brief The built-in transport. With LCM's own receive buffer 2 of 300 frames would arrive.
inline constexpr const char* kDefaultLcmUrl =
    "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=2097152";

/// @brief Declares the options of one program or command. The variables handed in are both default
/// and destination; they must outlive run_program's body.
class OptionParser {
 public:
  explicit OptionParser(CLI::App& app) : app_(app) {}

  /// @brief A required argument without a name, in order of declaration, for example "LOG".
  void positional(const std::string& name, std::string& value, const std::string& help);
  /// @brief One or more arguments without a name; must be declared last.
  void positionals(const std::string& name, std::vector<std::string>& values,
                   const std::string& help);
  /// @brief Any number of them, also none; must be declared last.
  void optional_positionals(const std::string& name, std::vector<std::string>& values,
                            const std::string& help);
  void optional_positional(const std::string& name, std::string& value, const std::string& help);

  /// @brief A named option with a value, for example "-o,--output". The default is shown in the
  /// help.
  void option(const std::string& names, std::string& value, const std::string& help);
  void option(const std::string& names, double& value, const std::string& help);
  void option(const std::string& names, int& value, const std::string& help);
  void option(const std::string& names, std::int64_t& value, const std::string& help);
  /// @brief Without a default.
  void option(const std::string& names, std::optional<double>& value, const std::string& help);
  void option(const std::string& names, std::optional<std::int64_t>& value,
              const std::string& help);
  /// @brief May be given more than once.
  void option(const std::string& names, std::vector<std::string>& values, const std::string& help);
  /// @brief Comma-separated numbers, exactly `count`, for example "--up 0,-1,0".
  void numbers(const std::string& names, std::vector<double>& values, int count,
               const std::string& help);
  /// @brief A named option that must be given.
  void required(const std::string& names, std::string& value, const std::string& help);
  /// @brief True when given.
  void flag(const std::string& names, bool& value, const std::string& help);
  /// @brief One word of a list.
  void choice(const std::string& names, std::string& value, const std::vector<std::string>& choices,
              const std::string& help);

  /// @brief A sub-command with options of its own; `chosen` becomes its name when it is given. Once
  /// a program declares one, a command is required.
  void command(const std::string& name, const std::string& help, std::string& chosen,
               const std::function<void(OptionParser&)>& declare);

 private:
  CLI::App& app_;
};

/// @brief What a program is, and which of the common options it has.
struct ProgramInfo {
  std::string name;         // "geomap-replay"
  std::string description;  // one sentence
  bool uses_lcm = false;    // -l/--lcm-url and --channel-prefix
  bool uses_config = true;  // -c/--config and --set
};

/// @brief What the common options say.
struct CommonOptions {
  Config config;
  std::string lcm_url;         // option, else LCM_DEFAULT_URL, else kDefaultLcmUrl
  std::string channel_prefix;  // put before every channel name, for example "robot1/"
};

/// @brief A whole main: parses, loads the config, installs signal handlers, runs `body` and turns
/// what it throws into one line on stderr. -h and --version print and end with 0.
/// @return body's result; 1 when it throws; 2 for wrong usage or a ConfigError.
int run_program(int argc, const char* const* argv, const ProgramInfo& info,
                const std::function<void(OptionParser&)>& declare,
                const std::function<int(const CommonOptions&)>& body);

/// @brief The project's version, for example "0.1.0".
std::string version();

/// @brief True once SIGINT or SIGTERM has come: loops end cleanly. A second signal kills.
bool stop_requested();
/// @brief The same from the program itself.
void request_stop();

}  // namespace geomap::messaging
