// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "geometry/plane.hpp"

namespace geomap::drivers {

/// @brief Rings in the world frame [m], all on the plane; seen from the side the normal points to,
/// outer runs counter-clockwise, holes clockwise.
struct TruthPolygon {
  std::vector<Eigen::Vector3d> outer;
  std::vector<std::vector<Eigen::Vector3d>> holes;
};

/// @brief One true planar surface.
struct TruthPlane {
  std::string name;
  geometry::Plane plane;              // world frame, normal to the side it can be seen from
  double area = 0.0;                  // [m²]
  double visible_area = 0.0;          // [m²]
  bool seen = false;                  // some of it could have been seen
  TruthPolygon polygon;               // its whole outline
  std::vector<TruthPolygon> visible;  // parts that the camera could have seen
  /// A point on it [m], when it is a reference plane whose outline nobody knows; polygon is empty
  /// then.
  std::optional<Eigen::Vector3d> centroid;
};

/// @brief What a map can be measured against.
struct Truth {
  std::vector<TruthPlane> planes;
};

}  // namespace geomap::drivers
