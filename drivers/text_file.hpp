// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace geomap::drivers {

/// @brief Writes a file; an old one stays until the new one is whole.
/// @throws SourceError naming the file when it cannot be written.
void write_text_file(const std::filesystem::path& path, const std::string& text);

}  // namespace geomap::drivers
