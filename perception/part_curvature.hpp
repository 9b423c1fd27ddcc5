// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "geometry/plane_moments.hpp"
#include "perception/plane_pixels.hpp"

namespace geomap::perception {

/// @brief How a surface bends where it bends most.
struct PartCurvature {
  double value = 0.0;    // 1 / radius [1/m]
  double sigma = 0.0;    // its standard deviation [1/m]
  double sagitta = 0.0;  // height of the bow over the part, in that direction [m]
};

/// @brief Curvature of the quadric that fits best a part's cell points, seen as a height over its
/// plane. Noise within a tolerance does not tell a cylinder from a plane; this does.
/// @return nothing for fewer cells than a quadric needs, or cells on one line.
std::optional<PartCurvature> curvature_of(const std::vector<CellPoint>& part,
                                          const geometry::PlaneFit& fit);

}  // namespace geomap::perception
