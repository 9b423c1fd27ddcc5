// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "geometry/planar_polygon.hpp"
#include "viewer/gl_buffer.hpp"

namespace geomap::viewer {

/// @brief A planar surface as vertices, in the frame of its polygon.
struct SurfaceShape {
  std::vector<Vertex> triangles;
  std::vector<Vertex> outline;  // lines of all rings, with the way along them
  Eigen::Isometry3d T_world_shape = Eigen::Isometry3d::Identity();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // world frame
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();   // a point near the centroid, world frame

  bool empty() const { return outline.empty(); }
};

/// @brief With triangles; the middle is in no hole. Empty for an empty polygon, and for one that is
/// nowhere because a number of its place is none.
SurfaceShape shape_of(const geometry::PlanarPolygon& surface);

/// @brief The same without triangles, which costs little; the middle is the centroid.
SurfaceShape outline_shape_of(const geometry::PlanarPolygon& surface);

}  // namespace geomap::viewer
