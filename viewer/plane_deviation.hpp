// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "geometry/planar_polygon.hpp"
#include "viewer/scene_model.hpp"

namespace geomap::viewer {

/// @brief How far a plane that was seen lies from the surface of the map that it belongs to: rms
/// over its area [m]. It belongs to what faces the same way within 15 degrees, lies under most of
/// it, and is nearest, no farther than 0.3 m; nothing: the map has none, or the plane is nowhere.
/// World frame.
std::optional<double> distance_from_map(const geometry::PlanarPolygon& seen,
                                        const Features& features);

}  // namespace geomap::viewer
