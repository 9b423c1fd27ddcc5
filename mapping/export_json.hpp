// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mapping/map_snapshot.hpp"

namespace geomap::mapping {

/// @brief The map as the content of `map.json`, a stable schema for other programs; world frame (z
/// up), metres, radians, utimes in microseconds:
///
///     {"revision", "hash", "features": [{"id", "label", "normal": [3], "d", "area",
///     "observations",
///      "first_utime", "last_utime", "rms", "sigma_angle", "sigma_d", "color": [3],
///      "polygons": [{"outer": [[x, y, z], ...], "holes": [[[x, y, z], ...], ...]}]}]}
///
/// Features ascend by id, one a line; `observations` is their number; colours are 0..255; outer
/// rings run counter-clockwise about the normal, holes clockwise. Numbers read back to the last
/// bit.
std::string to_map_json(const MapSnapshot& map);

}  // namespace geomap::mapping
