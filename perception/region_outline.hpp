// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/planar_polygon.hpp"
#include "geometry/rgbd_frame.hpp"
#include "perception/label_rings.hpp"

namespace geomap::perception {

/// @brief Fills the small holes of labelled regions: those of less than `largest` [m²] on the plane
/// in which no other label lies. Pixels without a reading get the region's label in `label`; all of
/// them get it in the image returned, of which outlines are to be traced.
/// @param planes of the labels, camera frame, d > 0
std::vector<std::int16_t> fill_holes(const geometry::RgbdFrame& frame,
                                     const std::vector<geometry::Plane>& planes, double largest,
                                     std::vector<std::int16_t>& label);

/// @brief Outlines of the labels, by label: the border of the pixels, simplified within a pixel,
/// where its corners' rays meet the plane, in the given frames; holes and several parts kept, parts
/// of a few pixels not. Free of depth noise. Empty where a ray misses the plane.
/// @param surfaces planes and frames, by label; their polygons are written.
void outline_regions(const geometry::CameraModel& camera, const std::vector<std::int16_t>& label,
                     std::vector<geometry::PlanarPolygon>& surfaces);

}  // namespace geomap::perception
