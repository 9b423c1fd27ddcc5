// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map_hash.hpp"

#include "mapping/digest.hpp"

namespace geomap::mapping {
namespace {

void add(Digest& digest, const MapFeature& feature) {
  digest.add(feature.id);
  digest.add(feature.surface.plane.normal);
  digest.add(feature.surface.plane.d);
  digest.add(feature.surface.frame.origin);
  digest.add(feature.surface.frame.x_axis);
  digest.add(feature.surface.frame.normal);
  for (const double value : feature.moments.to_array()) digest.add(value);
  digest.add(feature.surface.polygon);
  digest.add(feature.observations.size());
  for (const ObservationId& id : feature.observations) digest.add(id);
  digest.add(feature.inliers);
  for (const double channel : feature.color) digest.add(channel);
  digest.add(feature.label);
  digest.add(feature.other_labels.size());
  for (const std::string& label : feature.other_labels) digest.add(label);
  digest.add(feature.is_held());
}

}  // namespace

std::string map_hash(const FeatureSet& features, const VetoSet& vetoes) {
  Digest digest;
  for (const auto& [id, feature] : features) add(digest, *feature);
  for (const auto& [key, veto] : vetoes) {
    digest.add(static_cast<std::int8_t>(veto->cause));
    add(digest, veto->feature);
  }
  return digest.hex();
}

}  // namespace geomap::mapping
