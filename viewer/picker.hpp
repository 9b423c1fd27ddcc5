// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <set>

#include "viewer/surface_cache.hpp"
#include "viewer/view_camera.hpp"

namespace geomap::viewer {

struct Hit {
  mapping::FeatureId id;
  double distance = 0.0;  // along the ray [m]
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
};

/// @brief Distance along a ray to where it goes through a plane ahead; nothing when it is nearly
/// parallel to it (within 0.5°) or the plane lies behind.
std::optional<double> distance_to_plane(const Ray& ray, const geometry::Plane& plane);

/// @brief The nearest feature under a pixel. One that is seen edge-on, as walls are from above,
/// counts when its outline is within a few pixels.
std::optional<Hit> pick_feature(const SurfaceCache& cache, const ViewCamera& camera,
                                const Eigen::Vector2d& pixel);

/// @brief The features that lie whole inside a rectangle of the picture, whatever is before them.
std::set<mapping::FeatureId> features_inside(const SurfaceCache& cache, const ViewCamera& camera,
                                             const Eigen::AlignedBox2d& rectangle);

/// @brief Distance of a point from the piece between two others [px].
double distance_to_segment(const Eigen::Vector2d& point, const Eigen::Vector2d& a,
                           const Eigen::Vector2d& b);

}  // namespace geomap::viewer
