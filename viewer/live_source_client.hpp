// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "messaging/bus.hpp"
#include "viewer/map_source.hpp"

namespace geomap::viewer {

/// @brief A running system: what its processes publish, and edits for its mapper.
///
/// Asks for the whole map, history and point map at the start, when one of the processes was
/// started anew, when something is missing, and after a silence. Commands are sent again every half
/// second until they are answered, for ten seconds.
/// @throws as messaging::Bus.
std::unique_ptr<MapSource> open_live(const messaging::BusConfig& config);

}  // namespace geomap::viewer
