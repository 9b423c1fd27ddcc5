// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "mapping/geometric_map.hpp"
#include "mapping/map_snapshot.hpp"

namespace geomap::mapping {

/// A map on disk is an LCM log, readable by lcm-logplayer and every other tool: one MAP_EVENT for
/// each event of the history, then one MAP_STATE with the exact features, settings and hash.

/// @brief Writes a map (customary name: map.lcmlog). The old file stays until the new one is whole.
/// @throws std::runtime_error naming the path when it cannot be written.
void save_map(const std::filesystem::path& path, const GeometricMap& map);

/// @brief The map as it was saved, to the last bit.
/// @throws std::runtime_error, one line with the path, when the file is missing, not a map,
/// damaged, or when its features do not have the hash it states.
SavedMap load_map(const std::filesystem::path& path);

/// @brief Features, revision and hash, for exports.
MapSnapshot snapshot_of(std::int64_t revision, const FeatureSet& features);
MapSnapshot snapshot_of(const SavedMap& saved);
MapSnapshot snapshot_of(const GeometricMap& map);

}  // namespace geomap::mapping
