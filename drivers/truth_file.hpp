// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "drivers/truth.hpp"

namespace geomap::drivers {

/// @brief Reads true planes (YAML: `planes: [{name, normal, d, area, visible_area,
/// seen, polygon, visible}]`). A plane may have a `centroid` instead of all from `area` on; it then
/// counts as seen. Normals are made unit vectors, d with them. What it does not know it passes
/// over.
/// @throws SourceError, one line naming file and line, when it is no such file: a key missing, a
/// number that is not finite or a point beyond 10 km, a normal of length zero, a ring of fewer than
/// three vertices or one with a vertex more than 1 mm off its plane.
Truth read_truth(const std::filesystem::path& path);

/// @brief Writes true planes; points and areas are rounded to 1e-6, planes are kept to the last
/// bit, the same truth gives the same bytes. The old file stays until the new one is whole.
/// @throws SourceError naming the file when it cannot be written.
void write_truth(const Truth& truth, const std::filesystem::path& path);

}  // namespace geomap::drivers
