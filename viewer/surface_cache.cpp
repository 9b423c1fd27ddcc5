// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/surface_cache.hpp"

#include "mapping/feature_filter.hpp"

namespace geomap::viewer {
namespace {

Surface surface_in_metres(const mapping::ViewFeature& feature) {
  Surface surface;
  surface.polygon = mapping::surface_of(feature);
  surface.box = surface.polygon.bounding_box();
  const mapping::FeatureFacts facts = mapping::facts_of(feature);
  surface.centroid = facts.centroid;
  surface.area = facts.area;
  return surface;
}

}  // namespace

void SurfaceCache::update(const MapLayer& map) {
  if (map.stamp == stamp_) return;
  stamp_ = map.stamp;
  std::map<mapping::FeatureId, Surface> surfaces;
  int number = 0;
  for (const auto& [id, feature] : map.features) {
    const auto known = features_.find(id);
    const bool is_same = known != features_.end() && known->second == feature;
    Surface surface = is_same ? std::move(surfaces_.at(id)) : surface_in_metres(feature);
    surface.number = ++number;
    surfaces.emplace_hint(surfaces.end(), id, std::move(surface));
  }
  surfaces_ = std::move(surfaces);
  features_ = map.features;
}

const Surface* SurfaceCache::find(const mapping::FeatureId& id) const {
  const auto found = surfaces_.find(id);
  return found == surfaces_.end() ? nullptr : &found->second;
}

}  // namespace geomap::viewer
