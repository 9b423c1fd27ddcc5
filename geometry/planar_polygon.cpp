// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/planar_polygon.hpp"

#include "geometry/polygon_clip.hpp"

namespace geomap::geometry {

Eigen::Vector3d PlanarPolygon::lift(const Eigen::Vector2d& uv) const {
  const Eigen::Vector3d base = frame.origin + uv.x() * frame.x_axis + uv.y() * frame.y_axis();
  const double height = -plane.signed_distance(base) / plane.normal.dot(frame.normal);
  return base + height * frame.normal;
}

Eigen::AlignedBox3d PlanarPolygon::bounding_box() const {
  Eigen::AlignedBox3d box;
  for (const PolygonPart& part : polygon.parts) {
    for (const GridPoint vertex : part.outer) box.extend(lift(vertex));
  }
  return box;
}

PlanarPolygon PlanarPolygon::transformed(const Eigen::Isometry3d& T_target_parent) const {
  return {plane.transformed(T_target_parent), frame.transformed(T_target_parent), polygon};
}

Polygon PlanarPolygon::in_frame(const PlaneFrame& other) const {
  const Eigen::Isometry3d T_other_parent = other.T_plane_parent();
  const auto moved = [&](const Ring& ring) {
    Ring result;
    result.reserve(ring.size());
    for (const GridPoint vertex : ring) {
      result.push_back(to_grid((T_other_parent * lift(vertex)).head<2>()));
    }
    return result;
  };
  std::vector<Ring> rings;
  for (const PolygonPart& part : polygon.parts) {
    rings.push_back(moved(part.outer));
    for (const Ring& hole : part.holes) rings.push_back(moved(hole));
  }
  return from_rings(rings, FillRule::kEvenOdd);
}

}  // namespace geomap::geometry
