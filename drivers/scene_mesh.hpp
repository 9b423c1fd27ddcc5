// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace geomap::drivers {

/// @brief Triangles of a file, in its own coordinates.
struct Mesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// @brief Reads an OBJ or GLB file, the transforms of its nodes applied. glTF's y axis points up:
/// a GLB file is turned so that z does.
/// @throws SourceError for a file of another kind, that cannot be read or holds no triangles.
Mesh read_mesh(const std::filesystem::path& file);

}  // namespace geomap::drivers
