// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "drivers/truth.hpp"
#include "geometry/plane_frame.hpp"
#include "mapping/map_feature.hpp"

namespace geomap::testing {

/// @brief A rectangle in a plane frame [m].
struct DrawnRectangle {
  double left = 0.0;
  double bottom = 0.0;
  double right = 0.0;
  double top = 0.0;
};

/// @brief A true rectangle with rectangular openings, seen as the `visible` rectangles.
drivers::TruthPlane draw_truth(const std::string& name, const geometry::PlaneFrame& frame,
                               const DrawnRectangle& whole,
                               const std::vector<DrawnRectangle>& visible,
                               const std::vector<DrawnRectangle>& openings = {});

/// @brief A map feature of one part for each rectangle.
mapping::MapFeature draw_feature(std::int64_t id, const geometry::PlaneFrame& frame,
                                 const std::vector<DrawnRectangle>& parts);

/// @brief The frame turned about its y axis through its origin [rad].
geometry::PlaneFrame tilted(const geometry::PlaneFrame& frame, double angle);
/// @brief The frame moved along its normal [m].
geometry::PlaneFrame raised(const geometry::PlaneFrame& frame, double height);

}  // namespace geomap::testing
