// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/plane_deviation.hpp"

#include <algorithm>

#include "geometry/angles.hpp"
#include "geometry/polygon_clip.hpp"
#include "mapping/plane_similarity.hpp"

namespace geomap::viewer {
namespace {

constexpr double kMostAngle = 15.0;    // [deg]
constexpr double kMostDistance = 0.3;  // [m]
constexpr double kFarthest = 9e4;      // coordinates that are compared [m]
constexpr double kLeastShare = 0.5;    // of its area that lies over the map's surface

// Coordinates of the surface in a frame [m]; empty when one is no number.
Eigen::AlignedBox2d box_in(const geometry::PlaneFrame& frame,
                           const geometry::PlanarPolygon& surface) {
  const Eigen::Isometry3d T_frame_world = frame.T_plane_parent();
  Eigen::AlignedBox2d box;
  for (const geometry::GridPoint vertex : geometry::vertices(surface.polygon)) {
    const Eigen::Vector3d at = T_frame_world * surface.lift(vertex);
    if (!at.allFinite()) return {};
    box.extend(at.head<2>().eval());
  }
  return box;
}

bool lies_over(const geometry::PlanarPolygon& seen, const geometry::PlanarPolygon& surface) {
  // What is beyond the grid of polygon coordinates cannot be cut, nor what is nowhere.
  const Eigen::AlignedBox2d box = box_in(seen.frame, surface);
  const bool is_on_grid =
      !box.isEmpty() && box.min().minCoeff() > -kFarthest && box.max().maxCoeff() < kFarthest;
  if (!is_on_grid || !box.intersects(geometry::bounding_box(seen.polygon))) return false;
  const geometry::Polygon common = geometry::intersect(seen.polygon, surface.in_frame(seen.frame));
  return geometry::area(common) >= kLeastShare * geometry::area(seen.polygon);
}

}  // namespace

std::optional<double> distance_from_map(const geometry::PlanarPolygon& seen,
                                        const Features& features) {
  const Eigen::Isometry3d T_plane_world = seen.frame.T_plane_parent();
  const geometry::Plane own = seen.plane.transformed(T_plane_world);
  const geometry::AreaMoments area = geometry::area_moments(seen.polygon);
  std::optional<double> nearest;
  for (const auto& [id, feature] : features) {
    const geometry::PlanarPolygon surface = mapping::surface_of(feature);
    if (angle_between(seen.plane, surface.plane) > geometry::radians(kMostAngle)) continue;
    const double distance =
        mapping::rms_distance(own, surface.plane.transformed(T_plane_world), area);
    if (distance > std::min(kMostDistance, nearest.value_or(kMostDistance))) continue;
    if (lies_over(seen, surface)) nearest = distance;
  }
  return nearest;
}

}  // namespace geomap::viewer
