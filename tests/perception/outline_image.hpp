// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/camera_model.hpp"
#include "geometry/planar_polygon.hpp"

namespace geomap::testing {

/// @brief The image of an outline: per pixel, does its ray meet the polygon?
std::vector<bool> outline_image(const geometry::PlanarPolygon& surface,
                                const geometry::CameraModel& camera);

/// @brief Pixels set in both.
std::size_t common_pixels(const std::vector<bool>& a, const std::vector<bool>& b);
/// @brief Pixels set.
std::size_t count_pixels(const std::vector<bool>& image);
/// @brief Pixels set in both, over pixels set in either.
double overlap_ratio(const std::vector<bool>& a, const std::vector<bool>& b);

}  // namespace geomap::testing
