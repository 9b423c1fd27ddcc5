// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "messaging/log_reader.hpp"

namespace geomap::logs {

/// @brief Reads a log to its end and hands out the events, with a progress bar where that takes
/// long. The reader's position is then behind the event.
/// @throws std::runtime_error, one line, on Ctrl-C.
void read_events(messaging::LogReader& reader,
                 const std::function<void(const messaging::LogEvent&)>& handle);

}  // namespace geomap::logs
