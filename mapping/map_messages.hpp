// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "geomap/edit_t.hpp"
#include "geomap/feature_state_t.hpp"
#include "geomap/keyframe_update_t.hpp"
#include "geomap/map_contents_t.hpp"
#include "geomap/map_event_t.hpp"
#include "geomap/observation_id_t.hpp"
#include "geomap/plane_set_t.hpp"
#include "mapping/map_contents.hpp"
#include "mapping/map_event.hpp"
#include "mapping/map_feature.hpp"

namespace geomap::mapping {

geomap::observation_id_t to_message(const ObservationId& id);
ObservationId from_message(const geomap::observation_id_t& id);

/// @brief An event, exact in every number.
geomap::map_event_t to_message(const MapEvent& event);
/// @brief The inverse; nothing for an unknown kind or a plane that is refused.
std::optional<MapEvent> from_message(const geomap::map_event_t& message);

/// @brief The planes of a key frame as extraction publishes them; null when one is refused.
std::shared_ptr<const Observation> from_message(const geomap::plane_set_t& message);

/// @brief What registration tells of key frames, as events in their order: all corrections
/// together, then each removal.
std::vector<MapEvent> from_message(const geomap::keyframe_update_t& message);

/// @brief An edit, exact in every number.
geomap::edit_t to_message(const Edit& edit);
/// @brief The inverse; nothing for an unknown kind.
std::optional<Edit> from_message(const geomap::edit_t& message);

/// @brief A feature of the map, exact in every number.
geomap::feature_state_t to_message(const MapFeature& feature);
/// @brief The inverse; nothing when the surface is not sound (find_fault), or the observations are
/// empty, unsorted, or do not begin with the id.
std::optional<MapFeature> from_message(const geomap::feature_state_t& message);

/// @brief All that a map holds, exact in every number.
geomap::map_contents_t to_message(const MapContents& contents);
/// @brief The inverse; nothing when a feature is refused.
/// @param config with which it was made.
std::optional<MapContents> from_message(const geomap::map_contents_t& message,
                                        const MergeConfig& config);

}  // namespace geomap::mapping
