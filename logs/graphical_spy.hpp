// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "messaging/program.hpp"

namespace geomap::logs {

/// @brief Becomes LCM's lcm-spy with what geomap-spy.jar, beside this program, adds to it.
/// @throws std::runtime_error, one line that says what to do, when that cannot be.
[[noreturn]] void run_graphical_spy(const messaging::CommonOptions& common);

}  // namespace geomap::logs
