// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mapping/map_snapshot.hpp"

namespace geomap::mapping {

/// @brief The map as the content of a binary glTF 2.0 file (.glb).
///
/// The root node turns the world (z up) to glTF's y up, and carries a whole-metre translation, so
/// that the 32-bit positions stay exact far from the origin. Each feature is a child node named by
/// its label, else its id, with a double-sided material of its own, and extras {id, label, normal,
/// d, area}; normal and d are those of the world frame. A feature without area is a node without a
/// mesh.
/// @throws std::invalid_argument when the map does not fit the format's 4 GiB.
std::string to_glb(const MapSnapshot& map);

}  // namespace geomap::mapping
