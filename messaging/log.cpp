// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/log.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <utility>

namespace geomap::messaging {
namespace {

std::shared_ptr<spdlog::logger> make_logger(const std::string& name) {
  auto sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
  auto logger = std::make_shared<spdlog::logger>(name, std::move(sink));
  logger->set_pattern("%H:%M:%S.%e %n %^%l%$: %v");
  return logger;
}

/// spdlog's own default logger writes to stdout, which belongs to results.
std::shared_ptr<spdlog::logger>& current_logger() {
  static std::shared_ptr<spdlog::logger> logger = make_logger("geomap");
  return logger;
}

}  // namespace

void set_log_name(const std::string& program) { current_logger() = make_logger(program); }

// The text is an argument, never a format: it may hold braces.
void log_info(const std::string& text) { current_logger()->info("{}", text); }
void log_warning(const std::string& text) { current_logger()->warn("{}", text); }
void log_error(const std::string& text) { current_logger()->error("{}", text); }

}  // namespace geomap::messaging
