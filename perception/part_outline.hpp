// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/camera_model.hpp"
#include "geometry/plane.hpp"
#include "geometry/plane_frame.hpp"
#include "geometry/polygon.hpp"
#include "perception/plane_parts.hpp"

namespace geomap::perception {

/// @brief Which pixel has which label, row by row.
struct LabelImage {
  const std::vector<std::int16_t>& label;
  int width = 0;
};

/// @brief The concave hull of one part of a plane, on the 0.1 mm grid of `frame`, which lies on
/// `plane`: an alpha shape, with its holes and pieces, not simplified.
///
/// Its points are where pixels' rays meet the plane, so they are free of depth noise: the outer
/// edges of border pixels, so that the outline does not shrink, and points inside, thinned.
/// @param index the plane's label.
/// @param alpha largest circumscribed circle of a triangle, radius [m]; where pixels are far apart
/// it is several of their lengths.
geometry::Polygon part_outline(const geometry::CameraModel& camera, const geometry::Plane& plane,
                               const geometry::PlaneFrame& frame, const LabelImage& image,
                               std::int16_t index, const PlanePart& part, double alpha);

}  // namespace geomap::perception
