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
constexpr double kLeastShare = 0.5;    // of its area that lies over the map's surface

bool lies_over(const geometry::PlanarPolygon& seen, const geometry::PlanarPolygon& surface) {
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
