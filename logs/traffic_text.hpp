// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "logs/traffic.hpp"

namespace geomap::logs {

/// @brief A table of the channels, and the sums above it. @param utime now, host's clock [us]
std::string traffic_text(const Traffic& traffic, std::int64_t utime);

}  // namespace geomap::logs
