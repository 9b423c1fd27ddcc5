// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace geomap::messaging {

/// @brief Lines for people, on stderr, with time, program name and level. For processes and mains:
/// libraries return reasons instead. set_log_name comes before any thread is started.
void set_log_name(const std::string& program);
void log_info(const std::string& text);
void log_warning(const std::string& text);
void log_error(const std::string& text);

}  // namespace geomap::messaging
