// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/rgbd_frame.hpp"
#include "perception/plane_observation.hpp"

namespace geomap::perception {

/// @brief How outlines are drawn.
struct OutlineSettings {
  double simplify_tolerance = 0.01;  // one pixel's length is added [m]
  double max_hole_area = 0.0025;  // holes below it, in which no other label lies, are filled [m²]
};

/// @brief Writes the polygons of parts: the border of their pixels, simplified, where its corners'
/// rays meet the plane; holes and several pieces kept, pieces of a few pixels not. Every vertex is
/// a corner of the border, so free of depth noise. Empty where a ray misses the plane.
/// @param label per pixel: index into `found`, or kNoPlane; pixels without a reading in holes that
/// are filled get the label of what surrounds them.
void outline_parts(const geometry::RgbdFrame& frame, const OutlineSettings& settings,
                   std::vector<std::int16_t>& label, std::vector<FoundPart>& found);

}  // namespace geomap::perception
