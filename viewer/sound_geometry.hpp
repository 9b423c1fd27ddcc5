// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "geometry/camera_model.hpp"
#include "geometry/planar_polygon.hpp"

namespace geomap::viewer {

/// @brief True for a rigid pose no farther than 100 km from the world's origin.
bool is_sound(const Eigen::Isometry3d& T);

/// @brief True for a surface with a simple polygon, whose frame lies on its plane as far as
/// rounding and merging let it, no farther than 100 km from the origin: whatever draws it can do
/// so.
bool is_sound(const geometry::PlanarPolygon& surface);

/// @brief True for a camera that can be built: its focal lengths and centre are within some image
/// sizes.
bool is_sound(const geometry::CameraModel& camera);

}  // namespace geomap::viewer
