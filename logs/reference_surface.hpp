// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drivers/truth.hpp"
#include "geometry/plane.hpp"
#include "geometry/plane_frame.hpp"
#include "geometry/polygon.hpp"
#include "mapping/map_feature.hpp"

namespace geomap::logs {

/// @brief A surface that a map is measured against: of a true scene, or of another map.
struct ReferenceSurface {
  std::string name;
  geometry::Plane plane;       // world frame, normal to the side it can be seen from
  bool seen = false;           // a map could hold it
  geometry::PlaneFrame frame;  // on the plane, parent: world
  geometry::Polygon outline;   // the whole surface, in `frame`
  geometry::Polygon visible;   // what of it could be seen, in `frame`
  /// A point on it [m], where nobody knows the outline; both polygons are empty then.
  std::optional<Eigen::Vector3d> centroid;
};

std::vector<ReferenceSurface> reference_surfaces(const drivers::Truth& truth);

/// @brief The features of a map as if all of them were true, named by label or id, by id.
std::vector<ReferenceSurface> reference_surfaces(std::span<const mapping::MapFeature> features);

/// @brief Number of parts of the visible area, of at least `min_area` [m²] each; what is closer
/// than `gap` [m] is one part.
std::size_t visible_components(const ReferenceSurface& surface, double gap, double min_area);

}  // namespace geomap::logs
