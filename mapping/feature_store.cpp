// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/feature_store.hpp"

#include <utility>

namespace geomap::mapping {
namespace {

// Features are immutable, but a fold that is repeated makes new ones: equal when nothing visible or
// fused differs.
bool same(const MapFeature& a, const MapFeature& b) {
  return a.observations == b.observations && a.label == b.label && a.held_by == b.held_by &&
         a.other_labels == b.other_labels && a.surface.polygon == b.surface.polygon &&
         a.surface.plane.normal == b.surface.plane.normal &&
         a.surface.plane.d == b.surface.plane.d &&
         a.surface.frame.origin == b.surface.frame.origin &&
         a.surface.frame.x_axis == b.surface.frame.x_axis &&
         a.moments.to_array() == b.moments.to_array();
}

}  // namespace

MapChange difference(const FeatureSet& before, const FeatureSet& after) {
  MapChange change;
  std::map<ObservationId, FeatureId> holder;  // of observations that features were named after
  for (const auto& [id, feature] : after) {
    if (feature == nullptr) continue;
    const auto old = before.find(id);
    const bool known = old != before.end() && old->second != nullptr;
    if (!known || (old->second != feature && !same(*old->second, *feature))) {
      change.upserted.insert(id);
    }
    for (const ObservationId& observation : feature->observations) {
      if (before.contains(observation)) holder.emplace(observation, id);
    }
  }
  for (const auto& [id, feature] : before) {
    const auto now = after.find(id);
    if (feature == nullptr || (now != after.end() && now->second != nullptr)) continue;
    const auto survivor = holder.find(id);
    if (survivor != holder.end()) {
      change.absorbed.emplace(id, survivor->second);
    } else {
      change.removed.insert(id);
    }
  }
  return change;
}

FeatureStore::FeatureStore(FeatureSet features) : features_(std::move(features)) {
  for (const auto& [id, feature] : features_) index_.insert(id, feature->surface.bounding_box());
}

void FeatureStore::note(const FeatureId& id) {
  const auto found = features_.find(id);
  touched_.emplace(id, found == features_.end() ? nullptr : found->second);
}

void FeatureStore::put(MapFeature feature) {
  note(feature.id);
  erase(feature.id);
  const FeatureId id = feature.id;
  index_.insert(id, feature.surface.bounding_box());
  features_.emplace(id, std::make_shared<const MapFeature>(std::move(feature)));
}

void FeatureStore::erase(const FeatureId& id) {
  const auto found = features_.find(id);
  if (found == features_.end()) return;
  note(id);
  index_.remove(id, found->second->surface.bounding_box());
  features_.erase(found);
}

std::vector<FeatureId> FeatureStore::near(const geometry::PlanarPolygon& surface,
                                          double reach) const {
  const Eigen::AlignedBox3d box = surface.bounding_box();
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(reach);
  return index_.query(Eigen::AlignedBox3d(box.min() - margin, box.max() + margin));
}

MapChange FeatureStore::take_change() {
  FeatureSet now;
  for (const auto& [id, before] : touched_) {
    const auto found = features_.find(id);
    now.emplace(id, found == features_.end() ? nullptr : found->second);
  }
  return difference(std::exchange(touched_, {}), now);
}

}  // namespace geomap::mapping
