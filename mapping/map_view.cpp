// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map_view.hpp"

#include <stdexcept>

#include "mapping/digest.hpp"

namespace geomap::mapping {
namespace {

void add(Digest& digest, const ViewFeature& feature) {
  digest.add(feature.id);
  for (const std::int32_t value : feature.origin) digest.add(value);
  for (const std::int32_t value : feature.normal) digest.add(value);
  for (const std::int16_t value : feature.x_axis) digest.add(value);
  digest.add(feature.polygon);
  digest.add(feature.observations);
  digest.add(feature.rms);
  digest.add(feature.sigma_angle);
  digest.add(feature.sigma_d);
  for (const std::uint8_t channel : feature.color) digest.add(channel);
  digest.add(feature.locked);
  digest.add(feature.label);
}

}  // namespace

ViewDelta delta_after(const MapView& view, const FeatureSet& features, const MapChange& change,
                      const ViewTolerance& tolerance) {
  ViewDelta delta;
  delta.utime = view.utime;
  delta.epoch = view.epoch;
  delta.revision = view.revision + 1;
  for (const FeatureId& id : change.upserted) {
    ViewFeature now = quantised(*features.at(id));
    const auto sent = view.features.find(id);
    if (sent == view.features.end() || looks_different(sent->second, now, tolerance)) {
      delta.changed.push_back(std::move(now));
    }
  }
  delta.removed = change.removed;
  delta.absorbed = change.absorbed;
  return delta;
}

void apply(const ViewDelta& delta, MapView& view) {
  if (delta.epoch != view.epoch || delta.revision != view.revision + 1) {
    throw std::invalid_argument("a delta does not follow upon this view");
  }
  for (const FeatureId& id : delta.removed) view.features.erase(id);
  for (const auto& [id, survivor] : delta.absorbed) view.features.erase(id);
  for (const ViewFeature& feature : delta.changed) {
    view.features.insert_or_assign(feature.id, feature);
  }
  view.utime = delta.utime;
  view.revision = delta.revision;
}

std::string view_hash(const MapView& view) {
  Digest digest;
  for (const auto& [id, feature] : view.features) add(digest, feature);
  return digest.hex();
}

}  // namespace geomap::mapping
