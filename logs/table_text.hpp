// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace geomap::logs {

/// @brief Columns as wide as need be; the first two, which hold names, to the left, numbers to the
/// right. All rows have as many cells as the first one.
std::string table_text(const std::vector<std::vector<std::string>>& rows);

/// @brief For example "1 event", "2 events".
std::string count_text(std::size_t count, const std::string& what);

/// @brief For example "1.5 kB".
std::string size_text(double bytes);
std::string size_text(std::int64_t bytes);

/// @brief Text from a message or a damaged file, which must not reach a terminal as it is: it may
/// hold commands for it.
std::string printable(std::string text);

}  // namespace geomap::logs
