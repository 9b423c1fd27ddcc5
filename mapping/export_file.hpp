// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

namespace geomap::mapping {

/// @brief Writes `content` to a temporary name beside `path` (path + ".part"), then renames it, so
/// that a reader never sees half a file and a failure leaves the old one as it was.
/// @throws std::runtime_error naming the path and the system's reason.
void write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace geomap::mapping
