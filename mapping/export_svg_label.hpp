// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace geomap::mapping {

/// @brief Closed rings in a picture [px]; the inside follows the even-odd rule.
using PictureRings = std::vector<std::vector<Eigen::Vector2d>>;

/// @brief A place for a label.
struct LabelSpot {
  Eigen::Vector2d point;
  double clearance = 0.0;  // distance to the nearest edge [px], positive
};

/// @brief Distance of a point to the nearest edge [px]; negative outside.
double clearance(const PictureRings& rings, const Eigen::Vector2d& point);

/// @brief Places inside the rings, the roomiest first: the point farthest from all edges (to 1 px;
/// for a ring-shaped area that is not its centroid) and points of a raster. Empty without an
/// inside.
std::vector<LabelSpot> label_spots(const PictureRings& rings);

}  // namespace geomap::mapping
