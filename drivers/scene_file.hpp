// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "drivers/scene.hpp"

namespace geomap::drivers {

/// @brief Reads a scene, with the meshes it names (config/scenes/README.md tells the format).
/// @throws SourceError, one line with file and line number, for whatever is wrong with it.
Scene read_scene(const std::filesystem::path& file);

}  // namespace geomap::drivers
