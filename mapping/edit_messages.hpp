// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "geomap/map_edit_record_t.hpp"
#include "geomap/map_edit_reply_t.hpp"
#include "geomap/map_edit_t.hpp"
#include "mapping/geometric_map.hpp"

namespace geomap::mapping {

/// @brief A command as a message; epoch, seen_utime and dry_run are the caller's.
geomap::map_edit_t to_message(const EditCommand& command);
/// @brief The inverse; nothing for an unknown kind.
std::optional<EditCommand> from_message(const geomap::map_edit_t& message);

/// @brief State of an edit, as in map_edit_record_t, and why, in words.
std::pair<std::int8_t, std::string> state_of(const EditEntry& entry, const GeometricMap& map);

/// @brief One edit of a map's history; utime, epoch and count are the caller's.
geomap::map_edit_record_t record_of(const EditEntry& entry, const GeometricMap& map);

/// @brief What an edit is about, for people: "label 2 features 'table'".
std::string describe(const Edit& edit);

/// @brief What came of a command, for people: "edit 3: delete 1 feature".
std::string describe(const EditResult& result);

/// @brief The answer to a command; epoch, revision and key frames are the caller's.
geomap::map_edit_reply_t reply_to(const EditCommand& command, const EditResult& result,
                                  bool is_dry_run, const GeometricMap& map);

/// @brief "done", "undone", "revoked" or "idle".
std::string state_name(const geomap::map_edit_record_t& record);

}  // namespace geomap::mapping
