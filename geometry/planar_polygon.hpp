// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>

#include "geometry/plane.hpp"
#include "geometry/plane_frame.hpp"
#include "geometry/plane_moments.hpp"
#include "geometry/polygon.hpp"

namespace geomap::geometry {

/// @brief A polygon on a plane in space. The rings are coordinates in `frame`; the surface is
/// `plane`, which may be turned a little against the frame: a vertex (u, v) is where the frame's
/// normal through (u, v) meets the plane.
struct PlanarPolygon {
  Plane plane;
  PlaneFrame frame;
  Polygon polygon;

  /// @brief Point [m] of the plane above the frame's coordinates (u, v) [m].
  Eigen::Vector3d lift(const Eigen::Vector2d& uv) const;
  Eigen::Vector3d lift(GridPoint vertex) const { return lift(to_metres(vertex)); }

  /// @brief Bounding box of the lifted vertices, in the frame's parent.
  Eigen::AlignedBox3d bounding_box() const;

  /// @brief The same surface in the parent `target`; the rings do not change.
  PlanarPolygon transformed(const Eigen::Isometry3d& T_target_parent) const;

  /// @brief The polygon as coordinates in another frame (lifted, then dropped along the other
  /// normal), made valid again on that frame's grid.
  Polygon in_frame(const PlaneFrame& other) const;
};

/// @brief One plane seen in one frame, in the camera frame: what plane extraction emits.
struct PlaneObservation {
  PlanarPolygon surface;     // frame's parent: camera; the normal looks at the camera
  PlaneMoments moments;      // of the inliers, camera frame, weights 1/σ_z², not capped
  std::int64_t inliers = 0;  // pixels
  double rms = 0.0;          // of the inliers about the plane [m]
  std::array<double, 3>
      color{};  // mean red, green, blue of the inliers, 0..255; zero without colour
};

}  // namespace geomap::geometry
