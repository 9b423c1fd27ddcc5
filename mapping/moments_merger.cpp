// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/moments_merger.hpp"

#include <optional>
#include <utility>

#include "geometry/angles.hpp"
#include "mapping/fuse.hpp"
#include "mapping/plane_similarity.hpp"

namespace geomap::mapping {
namespace {

struct Partner {
  FeatureId id;
  double overlap = 0.0;     // [m²]
  geometry::Polygon added;  // the younger one's polygon in the older one's frame
};

// The feature of the map that shares most area with `feature`, of those that are the same surface.
std::optional<Partner> find_partner(const MapFeature& feature, const FeatureStore& store,
                                    const MergeConfig& config) {
  std::optional<Partner> best;
  const double reach = config.gap + config.max_distance;
  for (const FeatureId& id : store.near(feature.surface, reach)) {
    const MapFeature& other = store.at(id);
    const bool other_is_older = other.id < feature.id;
    Similarity likeness =
        other_is_older ? compare(other, feature, config) : compare(feature, other, config);
    if (likeness.difference != Difference::kNone) continue;
    if (!best || likeness.overlap > best->overlap) {
      best = Partner{id, likeness.overlap, std::move(likeness.b_in_a)};
    }
  }
  return best;
}

MapFeature merge(MapFeature older, const MapFeature& younger, const geometry::Polygon& added,
                 const MergeConfig& config) {
  older.surface.polygon = united_outline(older.surface.polygon, added, config.outline_error);
  add_evidence(older, younger);
  refit(older);
  rebase_where_needed(older, geometry::radians(config.rebase_angle_deg));
  return older;
}

}  // namespace

void MomentsMerger::insert(MapFeature feature, FeatureStore& store) const {
  while (const std::optional<Partner> partner = find_partner(feature, store, config_)) {
    const MapFeature other = store.at(partner->id);
    store.erase(partner->id);
    feature = other.id < feature.id ? merge(other, feature, partner->added, config_)
                                    : merge(feature, other, partner->added, config_);
  }
  store.put(std::move(feature));
}

}  // namespace geomap::mapping
