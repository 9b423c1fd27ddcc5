// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "geomap/map_delta_t.hpp"
#include "geomap/map_t.hpp"
#include "mapping/map_view.hpp"

namespace geomap::mapping {

/// @brief Largest message for the operator [byte]: fits one packet of Ethernet or WLAN with LCM's
/// header, so that a lost packet costs one message.
inline constexpr std::size_t kMostViewMessageBytes = 1400;

/// @brief A delta as the messages that carry it; a single one when it fits. Only a label longer
/// than a message makes a larger one.
/// @param before view that the receiver has: of outlines only what is new is sent.
std::vector<geomap::map_delta_t> to_messages(const ViewDelta& delta, const MapView& before);
/// @brief The same for a snapshot of a view.
std::vector<geomap::map_t> to_messages(const MapView& view);

/// @brief The inverse, for all parts in order: nothing when they do not belong together, features
/// are not ascending, or one is not sound.
std::optional<ViewDelta> from_messages(const std::vector<geomap::map_delta_t>& parts,
                                       const MapView& before);
/// @brief The same; nothing either when the view does not have the hash that was stated.
std::optional<MapView> from_messages(const std::vector<geomap::map_t>& parts);

}  // namespace geomap::mapping
