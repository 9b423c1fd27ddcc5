// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mapping/map_snapshot.hpp"

namespace geomap::mapping {

enum class PlyFormat { kAscii, kBinaryLittleEndian };

/// @brief The map as the content of a PLY file: triangles, one colour per feature at the vertices;
/// world frame (z up), metres.
///
/// Coordinates are `float`: PCL reads `double` ones into its point types as zeros. Beyond 1024 m of
/// the world's origin floats are coarser than the polygons' 0.1 mm grid; then a whole-metre offset
/// is taken off and written as `comment offset X Y Z` (world = vertex + offset).
std::string to_ply(const MapSnapshot& map, PlyFormat format);

}  // namespace geomap::mapping
