// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/program.hpp"

#include <csignal>

#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <optional>

#include "messaging/log.hpp"

namespace geomap::messaging {
namespace {

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

extern "C" void handle_stop_signal(int /*signal*/) { stop = true; }

void install_signal_handlers() {
  struct sigaction action {};
  action.sa_handler = handle_stop_signal;
  // SA_RESETHAND: a second Ctrl-C ends a program that hangs. SA_RESTART: LCM does not expect EINTR.
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

std::string default_lcm_url() {
  const char* url = std::getenv("LCM_DEFAULT_URL");
  return url != nullptr && *url != '\0' ? url : kDefaultLcmUrl;
}

int fail(const ProgramInfo& info, const std::string& what, int code) {
  std::cerr << info.name << ": " << what << std::endl;
  return code;
}

/// The common options as they are parsed.
struct CommonArguments {
  std::optional<std::string> config_file;
  std::vector<std::string> overrides;
  std::string lcm_url = default_lcm_url();
  std::string channel_prefix;
};

void declare_common(CLI::App& app, const ProgramInfo& info, CommonArguments& common) {
  app.set_version_flag("--version", info.name + " " + version());
  if (info.uses_config) {
    app.add_option("-c,--config", common.config_file, "YAML file with settings that differ")
        ->type_name("FILE");
    app.add_option("--set", common.overrides, "One setting, for example merge.gap=0.05")
        ->type_name("KEY=VALUE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  }
  if (info.uses_lcm) {
    app.add_option("-l,--lcm-url", common.lcm_url, "How messages travel")
        ->type_name("URL")
        ->capture_default_str();
    app.add_option("--channel-prefix", common.channel_prefix, "Put before every channel name")
        ->type_name("TEXT");
  }
}

}  // namespace

void OptionParser::positional(const std::string& name, std::string& value,
                              const std::string& help) {
  app_.add_option(name, value, help)->required()->type_name("");
}

void OptionParser::positionals(const std::string& name, std::vector<std::string>& values,
                               const std::string& help) {
  app_.add_option(name, values, help)->required()->type_name("");
}

void OptionParser::optional_positionals(const std::string& name, std::vector<std::string>& values,
                                        const std::string& help) {
  app_.add_option(name, values, help)->type_name("");
}

void OptionParser::optional_positional(const std::string& name, std::string& value,
                                       const std::string& help) {
  app_.add_option(name, value, help)->type_name("");
}

void OptionParser::option(const std::string& names, std::string& value, const std::string& help) {
  app_.add_option(names, value, help)->capture_default_str();
}

void OptionParser::option(const std::string& names, double& value, const std::string& help) {
  app_.add_option(names, value, help)->capture_default_str();
}

void OptionParser::option(const std::string& names, int& value, const std::string& help) {
  app_.add_option(names, value, help)->capture_default_str();
}

void OptionParser::option(const std::string& names, std::int64_t& value, const std::string& help) {
  app_.add_option(names, value, help)->capture_default_str();
}

void OptionParser::option(const std::string& names, std::optional<double>& value,
                          const std::string& help) {
  app_.add_option(names, value, help);
}

void OptionParser::option(const std::string& names, std::optional<std::int64_t>& value,
                          const std::string& help) {
  app_.add_option(names, value, help);
}

void OptionParser::option(const std::string& names, std::vector<std::string>& values,
                          const std::string& help) {
  app_.add_option(names, values, help)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void OptionParser::numbers(const std::string& names, std::vector<double>& values, int count,
                           const std::string& help) {
  app_.add_option(names, values, help)->delimiter(',')->expected(count);
}

void OptionParser::required(const std::string& names, std::string& value, const std::string& help) {
  app_.add_option(names, value, help)->required();
}

void OptionParser::flag(const std::string& names, bool& value, const std::string& help) {
  app_.add_flag(names, value, help);
}

void OptionParser::choice(const std::string& names, std::string& value,
                          const std::vector<std::string>& choices, const std::string& help) {
  app_.add_option(names, value, help)->check(CLI::IsMember(choices))->capture_default_str();
}

void OptionParser::command(const std::string& name, const std::string& help, std::string& chosen,
                           const std::function<void(OptionParser&)>& declare) {
  app_.require_subcommand(1);
  CLI::App* command = app_.add_subcommand(name, help);
  command->fallthrough();  // common options may come after the command
  command->callback([name, &chosen] { chosen = name; });
  OptionParser options(*command);
  declare(options);
}

int run_program(int argc, const char* const* argv, const ProgramInfo& info,
                const std::function<void(OptionParser&)>& declare,
                const std::function<int(const CommonOptions&)>& body) {
  CLI::App app(info.description, info.name);
  CommonArguments common;
  OptionParser options(app);
  declare(options);
  declare_common(app, info, common);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wish) {  // -h or --version
    return app.exit(wish, std::cout, std::cerr);
  } catch (const CLI::ParseError& error) {
    return fail(info, std::string(error.what()) + " (see --help)", kWrongUsage);
  }

  try {
    set_log_name(info.name);
    install_signal_handlers();
    return body({Config::load(common.config_file, common.overrides), common.lcm_url,
                 common.channel_prefix});
  } catch (const ConfigError& error) {
    return fail(info, error.what(), kWrongUsage);
  } catch (const std::exception& error) {
    return fail(info, error.what(), kFailed);
  }
}

std::string version() { return GEOMAP_VERSION; }

bool stop_requested() { return stop; }

void request_stop() { stop = true; }

}  // namespace geomap::messaging
