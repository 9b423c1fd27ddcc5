// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "geomap/map_state_t.hpp"
#include "mapping/geometric_map.hpp"
#include "mapping/map_snapshot.hpp"

namespace geomap::mapping {

/// A map on disk is an LCM log, readable by lcm-logplayer and every other tool: one MAP_EVENT for
/// each event of the history, then one MAP_STATE with the exact features, settings and hash. A
/// journal goes on from there with events, and now and then another MAP_STATE.

/// @brief Writes a map (customary name: map.lcmlog). The old file stays until the new one is whole.
/// Returns when it is on disk. @throws std::runtime_error naming the path when it cannot be
/// written.
void save_map(const std::filesystem::path& path, const GeometricMap& map);

/// @brief The map as it was saved, to the last bit.
/// @throws std::runtime_error, one line with the path, when the file is missing, not a map,
/// damaged, or when its features do not have the hash it states.
SavedMap load_map(const std::filesystem::path& path);

/// @brief What a journal holds.
struct LoadedJournal {
  SavedMap saved;               // as of the last MAP_STATE
  std::vector<MapEvent> later;  // behind it
  std::int64_t begin = 0;       // end of the first MAP_STATE [byte]
  std::int64_t end = 0;         // of the last whole event; what is behind is torn [byte]
  std::int64_t torn = 0;        // size of that [byte]
  std::int64_t damaged = 0;     // in the middle, passed over [byte]
};

/// @brief Reads a journal whose last record may be torn.
/// @throws std::runtime_error as load_map, but for damage behind the first MAP_STATE.
LoadedJournal load_journal(const std::filesystem::path& path);

/// @brief True when both fold the same events to the same map.
bool is_same_merging(const MergeConfig& a, const MergeConfig& b);

/// @brief Goes on with a saved map under settings that may be others than those it was made with.
/// With another way of merging it is folded anew from its events.
GeometricMap reopen(SavedMap saved, const MergeConfig& merge, const HistoryConfig& history);

/// @brief The exact state of a map, without its events.
geomap::map_state_t state_of(const SavedMap& saved);

/// @brief Features, vetoes, revision and hash, for exports.
MapSnapshot snapshot_of(std::int64_t revision, const FeatureSet& features,
                        const VetoSet& vetoes = {});
MapSnapshot snapshot_of(const SavedMap& saved);
MapSnapshot snapshot_of(const GeometricMap& map);

}  // namespace geomap::mapping
