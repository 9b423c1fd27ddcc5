// SPDX-License-Identifier: BSD-3-Clause
#include "logs/reference_surface.hpp"

#include "geometry/polygon_clip.hpp"
#include "mapping/export_features.hpp"

namespace geomap::logs {
namespace {

geometry::PlaneFrame frame_near(const geometry::Plane& plane, const Eigen::Vector3d& point) {
  return geometry::PlaneFrame::on(plane, point, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY());
}

geometry::Polygon in_frame(const drivers::TruthPolygon& polygon,
                           const Eigen::Isometry3d& T_plane_world) {
  std::vector<geometry::Ring> rings;
  const auto add = [&](const std::vector<Eigen::Vector3d>& points) {
    geometry::Ring& ring = rings.emplace_back();
    for (const Eigen::Vector3d& point : points) {
      ring.push_back(geometry::to_grid((T_plane_world * point).head<2>()));
    }
  };
  add(polygon.outer);
  for (const auto& hole : polygon.holes) add(hole);
  return geometry::from_rings(rings, geometry::FillRule::kEvenOdd);
}

ReferenceSurface to_surface(const drivers::TruthPlane& truth) {
  ReferenceSurface surface{truth.name, truth.plane, truth.seen, {}, {}, {}, truth.centroid};
  if (truth.polygon.outer.empty()) return surface;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : truth.polygon.outer) box.extend(point);
  surface.frame = frame_near(truth.plane, box.center());
  const Eigen::Isometry3d T_plane_world = surface.frame.T_plane_parent();
  surface.outline = in_frame(truth.polygon, T_plane_world);
  std::vector<geometry::Polygon> parts;
  for (const auto& part : truth.visible) parts.push_back(in_frame(part, T_plane_world));
  surface.visible = geometry::unite(parts);
  return surface;
}

ReferenceSurface to_surface(const mapping::MapFeature& feature) {
  ReferenceSurface surface;
  surface.name = feature.label.empty() ? to_string(feature.id) : feature.label;
  surface.plane = feature.surface.plane;
  surface.seen = true;
  surface.frame = frame_near(surface.plane, feature.surface.bounding_box().center());
  surface.outline = feature.surface.in_frame(surface.frame);
  surface.visible = surface.outline;
  return surface;
}

}  // namespace

std::vector<ReferenceSurface> reference_surfaces(const drivers::Truth& truth) {
  std::vector<ReferenceSurface> surfaces;
  for (const drivers::TruthPlane& plane : truth.planes) surfaces.push_back(to_surface(plane));
  return surfaces;
}

std::vector<ReferenceSurface> reference_surfaces(std::span<const mapping::MapFeature> features) {
  std::vector<ReferenceSurface> surfaces;
  for (const mapping::MapFeature* feature : mapping::sorted_by_id(features)) {
    if (!feature->surface.polygon.empty()) surfaces.push_back(to_surface(*feature));
  }
  return surfaces;
}

std::size_t visible_components(const ReferenceSurface& surface, double gap, double min_area) {
  std::size_t components = 0;
  for (const geometry::PolygonPart& part : geometry::offset(surface.visible, gap / 2.0).parts) {
    const geometry::Polygon grown{{part}};
    if (geometry::area(geometry::intersect(grown, surface.visible)) >= min_area) ++components;
  }
  return components;
}

}  // namespace geomap::logs
