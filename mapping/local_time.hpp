// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace geomap::mapping {

/// @brief A time of the host's clock where the host is, for people and names of files.
/// @param utime since 1970 [us]. @param format as strftime has it, for at most 63 bytes of text.
std::string local_time(std::int64_t utime, const char* format);

/// @brief The same of now.
std::string local_time(const char* format);

}  // namespace geomap::mapping
