// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/export_json.hpp"

#include <nlohmann/json.hpp>

#include "mapping/export_features.hpp"

namespace geomap::mapping {
namespace {

using Json = nlohmann::ordered_json;

Json point_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json ring_json(const geometry::PlanarPolygon& surface, const geometry::Ring& ring) {
  Json points = Json::array();
  for (const geometry::GridPoint vertex : ring) points.push_back(point_json(surface.lift(vertex)));
  return points;
}

Json polygons_json(const geometry::PlanarPolygon& surface) {
  Json polygons = Json::array();
  for (const geometry::PolygonPart& part : surface.polygon.parts) {
    Json holes = Json::array();
    for (const geometry::Ring& hole : part.holes) holes.push_back(ring_json(surface, hole));
    polygons.push_back({{"outer", ring_json(surface, part.outer)}, {"holes", std::move(holes)}});
  }
  return polygons;
}

Json feature_json(const MapFeature& feature) {
  const geometry::PlanarPolygon& surface = feature.surface;
  const bool observed = !feature.observations.empty();
  return {{"id", to_string(feature.id)},
          {"label", clean_text(feature.label)},
          {"normal", point_json(surface.plane.normal)},
          {"d", surface.plane.d},
          {"area", geometry::area(surface.polygon)},
          {"observations", feature.observations.size()},
          {"first_utime", observed ? feature.first_utime() : feature.id.keyframe},
          {"last_utime", observed ? feature.last_utime() : feature.id.keyframe},
          {"rms", feature.rms},
          {"sigma_angle", feature.sigma_angle},
          {"sigma_d", feature.sigma_d},
          {"color", feature.color},
          {"held", feature.is_held()},
          {"polygons", polygons_json(surface)}};
}

// A surface that no observation fills.
Json veto_json(const Veto& veto) {
  return {{"edit", veto.edit},
          {"held", veto.cause != VetoCause::kDeleted},
          {"feature", to_string(veto.feature.id)},
          {"polygons", polygons_json(veto.feature.surface)}};
}

}  // namespace

std::string to_map_json(const MapSnapshot& map) {
  std::string text = "{\"revision\": " + std::to_string(map.revision) +
                     ", \"hash\": " + Json(clean_text(map.hash)).dump() + ", \"features\": [";
  const char* separator = "\n";
  for (const MapFeature* feature : sorted_by_id(map.features)) {
    text += separator + feature_json(*feature).dump();
    separator = ",\n";
  }
  text += "\n], \"vetoes\": [";
  separator = "\n";
  for (const Veto& veto : map.vetoes) {
    text += separator + veto_json(veto).dump();
    separator = ",\n";
  }
  return text + "\n]}\n";
}

}  // namespace geomap::mapping
