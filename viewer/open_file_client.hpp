// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>

#include "viewer/map_source.hpp"

namespace geomap::viewer {

/// @brief A saved map or a log, whichever the file is: a map begins with one of its events or its
/// state. @throws std::runtime_error, one line with the path.
std::unique_ptr<MapSource> open_file(const std::filesystem::path& file);

}  // namespace geomap::viewer
