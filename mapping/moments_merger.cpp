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

struct Search {
  std::optional<Partner> partner;
  std::int64_t candidates = 0;  // features that were looked at
};

// The feature of the map that shares most area with `feature`, of those that are the same surface.
Search find_partner(const MapFeature& feature, const FeatureStore& store,
                    const MergeConfig& config) {
  Search search;
  std::optional<Partner>& best = search.partner;
  const double reach = config.gap + config.max_distance;
  for (const FeatureId& id : store.near(feature.surface, reach)) {
    ++search.candidates;
    const MapFeature& other = store.at(id);
    const bool other_is_older = other.id < feature.id;
    const MapFeature &older = other_is_older ? other : feature,
                     &younger = other_is_older ? feature : other;
    Similarity likeness = compare(older, younger, config, best ? best->overlap : 0.0);
    if (likeness.difference != Difference::kNone) continue;
    if (!best || likeness.overlap > best->overlap) {
      best = Partner{id, likeness.overlap, std::move(likeness.b_in_a)};
    }
  }
  return search;
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

std::int64_t MomentsMerger::insert(MapFeature feature, FeatureStore& store) const {
  Search search = find_partner(feature, store, config_);
  std::int64_t candidates = search.candidates;
  while (search.partner) {
    const MapFeature other = store.at(search.partner->id);
    store.erase(search.partner->id);
    feature = other.id < feature.id ? merge(other, feature, search.partner->added, config_)
                                    : merge(feature, other, search.partner->added, config_);
    search = find_partner(feature, store, config_);
    candidates += search.candidates;
  }
  store.put(std::move(feature));
  return candidates;
}

}  // namespace geomap::mapping
