// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "viewer/scene_model.hpp"

namespace geomap::viewer {

/// @brief Where the grid of a map belongs, world z [m]: 0, unless the lowest level of the map is
/// farther from it than 0.3 m, as where a data set's origin is at eye height; then that level,
/// rounded to 1 cm. The lowest level is that of the lowest face upwards of 0.2 m2 or more, or the
/// bottom of all faces where there is none.
double lowest_level(const Features& features);

}  // namespace geomap::viewer
