// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/veto.hpp"

#include <cmath>

#include "geometry/angles.hpp"
#include "geometry/polygon_clip.hpp"
#include "mapping/plane_similarity.hpp"

namespace geomap::mapping {
namespace {

// Of the normals, beyond which a surface is another one: fragments at a distance are that far off.
constexpr double kLargestAngleDeg = 25.0;

bool are_near(const MapFeature& a, const MapFeature& b, double reach) {
  const Eigen::AlignedBox3d box = a.surface.bounding_box();
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(reach);
  return b.surface.bounding_box().intersects(
      Eigen::AlignedBox3d(box.min() - margin, box.max() + margin));
}

// Without what is narrower than `width` [m].
geometry::Polygon without_rims(const geometry::Polygon& polygon, double width) {
  const geometry::Polygon core = geometry::offset(polygon, -0.5 * width);
  if (core.empty()) return core;
  return geometry::intersect(polygon, geometry::offset(core, 0.75 * width));
}

}  // namespace

void add_veto(std::int64_t edit, VetoCause cause, const MapFeature& feature,
              const MergeConfig& config, VetoSet& vetoes) {
  vetoes.insert_or_assign(
      {edit, feature.id, cause},
      std::make_shared<const Veto>(
          Veto{edit, cause, feature, geometry::offset(feature.surface.polygon, config.gap)}));
}

bool cut_vetoed(MapFeature& feature, const VetoSet& vetoes, const MergeConfig& config) {
  const double least_cosine = std::cos(geometry::radians(kLargestAngleDeg));
  const geometry::PlaneFrame& frame = feature.surface.frame;
  const geometry::Plane own = feature.surface.plane.transformed(frame.T_plane_parent());
  for (const auto& [key, veto] : vetoes) {
    const MapFeature& vetoed = veto->feature;
    if (vetoed.surface.plane.normal.dot(feature.surface.plane.normal) < least_cosine) continue;
    const double reach = merging_reach(feature, vetoed, config);
    if (!are_near(feature, vetoed, reach + config.gap)) continue;
    const geometry::PlanarPolygon region{vetoed.surface.plane, vetoed.surface.frame, veto->region};
    const geometry::Polygon closed = region.in_frame(frame);
    const geometry::Polygon common = geometry::intersect(feature.surface.polygon, closed);
    if (common.empty()) continue;
    const geometry::Plane other = vetoed.surface.plane.transformed(frame.T_plane_parent());
    if (rms_distance(own, other, geometry::area_moments(common)) > reach) continue;
    feature.surface.polygon =
        without_rims(geometry::subtract(feature.surface.polygon, closed), 2.0 * config.gap);
    if (feature.surface.polygon.empty()) return false;
  }
  return true;
}

}  // namespace geomap::mapping
