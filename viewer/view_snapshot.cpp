// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/view_snapshot.hpp"

#include <cstddef>
#include <utility>

namespace geomap::viewer {
namespace {

constexpr double kDistanceUnit = 1e-4;  // of rms and sigma_d [m]
constexpr double kAngleUnit = 1e-5;     // of sigma_angle [rad]

mapping::MapFeature feature_of(const mapping::ViewFeature& view) {
  mapping::MapFeature feature;
  feature.id = view.id;
  feature.surface = mapping::surface_of(view);
  feature.observations = {view.id};
  feature.rms = kDistanceUnit * view.rms;
  feature.sigma_angle = kAngleUnit * view.sigma_angle;
  feature.sigma_d = kDistanceUnit * view.sigma_d;
  for (std::size_t i = 0; i < 3; ++i) feature.color[i] = view.color[i];
  feature.label = view.label;
  if (view.locked) feature.held_by = {0};  // by which edit is not told
  return feature;
}

}  // namespace

mapping::MapSnapshot snapshot_of(const MapLayer& layer) {
  mapping::MapSnapshot snapshot;
  snapshot.revision = layer.revision;
  for (const auto& [id, view] : layer.features) snapshot.features.push_back(feature_of(view));
  snapshot.vetoes = layer.vetoes;
  return snapshot;
}

}  // namespace geomap::viewer
