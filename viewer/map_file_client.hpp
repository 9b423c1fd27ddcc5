// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>

#include "viewer/map_source.hpp"

namespace geomap::viewer {

/// @brief A saved map, which is edited in this process: every command has its outcome at once. The
/// file stays as it is until the map is saved.
/// @throws std::runtime_error, one line with the path, as mapping::load_map.
std::unique_ptr<MapSource> open_map_file(const std::filesystem::path& file);

}  // namespace geomap::viewer
