// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "mapping/geometric_map.hpp"
#include "viewer/map_source.hpp"

namespace geomap::viewer {

/// @brief Shows a map that this process holds itself, as a mapper would show it.
void show(const mapping::GeometricMap& map, MapLayer& layer);
/// @brief Shows where the key frames of a map were taken.
void show_keyframes(const mapping::GeometricMap& map, TrackLayer& layer);

/// @brief All edits of a map, ascending by number.
std::vector<HistoryEntry> history_of(const mapping::GeometricMap& map);

/// @brief Does a command and says what came of it.
Outcome edit(const mapping::EditCommand& command, mapping::GeometricMap& map);

/// @brief Saves a map to a file. @param number of the outcome.
Outcome save(const mapping::GeometricMap& map, const std::filesystem::path& file,
             std::int64_t number);

}  // namespace geomap::viewer
