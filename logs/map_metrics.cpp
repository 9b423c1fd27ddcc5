// SPDX-License-Identifier: BSD-3-Clause
#include "logs/map_metrics.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/angles.hpp"
#include "geometry/polygon_clip.hpp"

namespace geomap::logs {
double stacked_area(const mapping::MapFeature& a, const mapping::MapFeature& b,
                    const DuplicateRule& rule) {
  const geometry::Plane& plane_a = a.surface.plane;
  const geometry::Plane& plane_b = b.surface.plane;
  if (std::abs(plane_a.normal.dot(plane_b.normal)) <
      std::cos(geometry::radians(rule.max_angle_deg))) {
    return 0.0;
  }
  const geometry::AreaMoments overlap = geometry::area_moments(
      geometry::intersect(a.surface.polygon, b.surface.in_frame(a.surface.frame)));
  if (overlap.area == 0.0) return 0.0;
  const double distance = std::abs(plane_b.signed_distance(a.surface.lift(overlap.centroid)));
  return distance <= rule.max_distance ? overlap.area : 0.0;
}

std::vector<std::pair<std::size_t, std::size_t>> find_duplicates(
    std::span<const mapping::MapFeature> features, const DuplicateRule& rule) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < features.size(); ++i) {
    for (std::size_t j = i + 1; j < features.size(); ++j) {
      const double smaller = std::min(geometry::area(features[i].surface.polygon),
                                      geometry::area(features[j].surface.polygon));
      if (smaller < rule.min_area) continue;
      if (stacked_area(features[i], features[j], rule) > rule.min_share * smaller) {
        pairs.emplace_back(i, j);
      }
    }
  }
  return pairs;
}

}  // namespace geomap::logs
