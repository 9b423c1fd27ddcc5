// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "geometry/planar_polygon.hpp"
#include "viewer/gl_buffer.hpp"
#include "viewer/painter.hpp"

namespace geomap::viewer {

/// @brief A planar surface as triangles and outline, in the frame of its polygon.
class SurfaceMesh {
 public:
  SurfaceMesh(const geometry::PlanarPolygon& surface, Painter& painter);

  bool empty() const { return outline_.size() == 0; }  // nothing of it can be drawn
  const GlBuffer& fill() const { return fill_; }
  const GlBuffer& outline() const { return outline_; }  // of all rings, with the way along them
  const Eigen::Isometry3d& T_world_mesh() const { return T_world_mesh_; }
  const Eigen::Vector3d& normal() const { return normal_; }  // world frame
  /// @brief A point of the surface, near its centroid: in no hole. World frame.
  const Eigen::Vector3d& middle() const { return middle_; }

 private:
  GlBuffer fill_, outline_;
  Eigen::Isometry3d T_world_mesh_;
  Eigen::Vector3d normal_, middle_;
};

/// @brief Brightness of a flat face by the light that falls on it: the same from everywhere, so
/// that faces are told apart by their direction alone.
float brightness(const Eigen::Vector3d& normal);

/// @brief The colour times the brightness, opacity unchanged.
Rgba shaded(const Rgba& color, float brightness);

/// @brief Part of the way from one colour to another, opacity of the first.
Rgba tinted(const Rgba& color, const Rgba& with, float share);

/// @brief The side that was not seen: paler, and seen through.
Rgba of_back(const Rgba& front, const Theme& theme);

}  // namespace geomap::viewer
