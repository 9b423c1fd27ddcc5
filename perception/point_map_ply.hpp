// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "perception/voxel_map.hpp"

namespace geomap::perception {

/// @brief Writes points as a binary little-endian PLY file: x, y, z as float [m], red, green, blue
/// as uchar; PCL, CloudCompare, MeshLab and Blender read it.
///
/// Floats are what those programs expect, and are good to 0.25 mm up to 4 km from the origin: until
/// there, the coordinates are those of the world. When any point lies farther out, all are written
/// relative to a whole number of metres near their middle, which the header gives as
/// `comment offset X Y Z`: world = offset + file.
/// @throws std::runtime_error, naming the path, when the file cannot be written.
void write_ply(const std::filesystem::path& path, const std::vector<MapPoint>& points);

}  // namespace geomap::perception
