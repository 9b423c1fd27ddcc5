// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "mapping/export_svg.hpp"
#include "mapping/map_snapshot.hpp"

namespace geomap::mapping {

struct ExportOptions {
  bool ascii = false;  // PLY as text instead of binary
  SvgOptions svg;
};

/// @brief Does nothing for a file that export_map knows how to write, by its extension.
/// @throws std::invalid_argument for another one, listing the known extensions.
void check_extension(const std::filesystem::path& out);

/// @brief Writes the map in the format of the file's extension: .ply, .obj (and .mtl beside it),
/// .glb, .svg or .json, in upper or lower case. The file appears whole or not at all.
/// @throws std::invalid_argument as check_extension; std::runtime_error naming the path and the
/// reason when it cannot be written.
void export_map(const MapSnapshot& map, const std::filesystem::path& out,
                const ExportOptions& options = {});

}  // namespace geomap::mapping
