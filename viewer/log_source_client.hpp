// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>

#include "viewer/map_source.hpp"

namespace geomap::viewer {

/// @brief A log, played at the pace of its time stamps. One that holds planes but no map, as
/// `geomap-replay --log-out` makes it, shows the map that they are folded into. The first updates
/// only find out how long the log is, which progress() shows.
/// @throws std::runtime_error, one line with the path, as messaging::LogReader.
std::unique_ptr<MapSource> open_log(const std::filesystem::path& file);

}  // namespace geomap::viewer
