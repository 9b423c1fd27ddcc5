// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "geometry/planar_polygon.hpp"

namespace geomap::logs {

/// @brief How far a mapped plane m = (n, d) is from a true one g: the paper's measures, and one
/// that does not depend on where the world's origin is. Of one feature, or means over several.
struct PlaneErrors {
  double coeff = 0.0;       // |m - g|, all four coefficients
  double angle = 0.0;       // between the normals [rad]
  double dist = 0.0;        // |d_m - d_g| [m], at the world's origin
  double dist_local = 0.0;  // distance of m from a point of g in the overlap [m]
  double rms_p = 0.0;       // rms distance of the outline's vertices from g [m]
};

/// @brief Root mean square of the distances [m] of all vertices, of all rings, from a plane.
double vertex_rms(const geometry::PlanarPolygon& surface, const geometry::Plane& truth);

/// @param at point of `truth` [m] where dist_local is taken.
PlaneErrors plane_errors(const geometry::PlanarPolygon& surface, const geometry::Plane& truth,
                         const Eigen::Vector3d& at);

/// @brief Mean of every measure, each feature counting once; zeros for none.
PlaneErrors mean_of(std::span<const PlaneErrors> errors);

}  // namespace geomap::logs
