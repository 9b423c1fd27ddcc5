// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/camera_model.hpp"
#include "geometry/plane.hpp"
#include "perception/plane_pixels.hpp"

namespace geomap::perception {

/// @brief Splits a plane's pixels into connected parts (paper: clustering of the inliers): pixels
/// of one part reach each other over gaps, along the image's axes, of at most `gap` on the plane
/// [m], and never less than a few pixels. Parts of fewer pixels than `least_pixels` are left out.
/// @param columns cells in a row of the image.
std::vector<PlanePart> split_into_parts(const geometry::CameraModel& camera, int columns,
                                        const geometry::Plane& plane,
                                        const std::vector<PlaneCell>& cells, double gap,
                                        int least_pixels);

}  // namespace geomap::perception
