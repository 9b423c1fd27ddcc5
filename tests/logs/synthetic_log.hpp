// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "messaging/log_reader.hpp"

namespace geomap::testing {

/// @brief The events of a short log: a camera of 320x240 passes a room of four rectangles; POSE is
/// the truth, CAMERA_TO_BODY is given. 30 Hz, first utime 10^9.
std::vector<messaging::LogEvent> synthetic_log(int frames, double sigma = 0.0);

/// @brief Writes events as an LCM log.
void write_log(const std::string& path, const std::vector<messaging::LogEvent>& events);

}  // namespace geomap::testing
