// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "room_costs.hpp"

namespace geomap::bench {

/// @brief SVG: what a key frame visits and takes, relative to the first row of rooms, and memory,
/// against the planes in the map. Dots are rooms, lines the medians of rows.
std::string plot_rooms(const RoomsRun& run, const RoomsWay& way);

}  // namespace geomap::bench
