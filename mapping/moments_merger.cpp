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
Search find_partner(const MapFeature& feature, const FeatureStore& store, const MergeConfig& config,
                    ClipMemo& memo) {
  Search search;
  std::optional<Partner>& best = search.partner;
  const double reach = config.gap + config.max_distance;
  for (const FeatureId& id : store.near(feature.surface, reach)) {
    const MapFeature& other = store.at(id);
    if (other.is_held()) continue;
    ++search.candidates;
    const bool other_is_older = other.id < feature.id;
    const MapFeature &older = other_is_older ? other : feature,
                     &younger = other_is_older ? feature : other;
    Similarity likeness = compare(older, younger, config, memo, best ? best->overlap : 0.0);
    if (likeness.difference != Difference::kNone) continue;
    if (!best || likeness.overlap > best->overlap) {
      best = Partner{id, likeness.overlap, std::move(likeness.b_in_a)};
    }
  }
  return search;
}

MapFeature merged(MapFeature older, const MapFeature& younger, const geometry::Polygon& added,
                  const MergeConfig& config, ClipMemo& memo) {
  older.surface.polygon = memo.united_outline(older.surface.polygon, added, config.outline_error);
  add_evidence(older, younger);
  refit(older);
  rebase_where_needed(older, geometry::radians(config.rebase_angle_deg));
  return older;
}

}  // namespace

std::int64_t MomentsMerger::insert(MapFeature feature, FeatureStore& store) const {
  Search search = find_partner(feature, store, config_, memo_);
  std::int64_t candidates = search.candidates;
  while (search.partner) {
    const MapFeature other = store.at(search.partner->id);
    store.erase(search.partner->id);
    feature = other.id < feature.id ? merged(other, feature, search.partner->added, config_, memo_)
                                    : merged(feature, other, search.partner->added, config_, memo_);
    search = find_partner(feature, store, config_, memo_);
    candidates += search.candidates;
  }
  store.put(std::move(feature));
  return candidates;
}

MapFeature MomentsMerger::merge(const MapFeature& older, const MapFeature& younger) const {
  return merged(older, younger, memo_.in_frame(younger.surface, older.surface.frame), config_,
                memo_);
}

}  // namespace geomap::mapping
