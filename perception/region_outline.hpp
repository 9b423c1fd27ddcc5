// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/planar_polygon.hpp"
#include "geometry/rgbd_frame.hpp"
#include "perception/label_rings.hpp"

namespace geomap::perception {

/// @brief How outlines are drawn.
struct OutlineSettings {
  double simplify_tolerance = 0.01;  // one pixel's length is added [m]
  double max_hole_area = 0.0025;  // holes below it, in which no other label lies, are filled [m²]
};

/// @brief Outlines of the labels, by label: the border of the pixels, simplified, where its
/// corners' rays meet the plane, in the given frames; holes and several parts kept, parts of a few
/// pixels not. Every vertex is a corner of the border, so free of depth noise. Empty where a ray
/// misses the plane.
/// @param label per pixel; pixels without a reading in holes that are filled get the label of what
/// surrounds them.
/// @param surfaces planes (d > 0) and frames, by label; their polygons are written.
void outline_regions(const geometry::RgbdFrame& frame, const OutlineSettings& settings,
                     std::vector<std::int16_t>& label,
                     std::vector<geometry::PlanarPolygon>& surfaces);

}  // namespace geomap::perception
