// SPDX-License-Identifier: BSD-3-Clause
#include "logs/reference_planes.hpp"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <ostream>

#include "geometry/angles.hpp"
#include "geometry/polygon_clip.hpp"
#include "logs/map_metrics.hpp"

namespace geomap::testing {
namespace {

constexpr double kLeastArea = 0.05;  // [m²]
constexpr double kAround = 0.15;     // [m]

Eigen::Vector3d vector_of(const YAML::Node& node) {
  return {node[0].as<double>(), node[1].as<double>(), node[2].as<double>()};
}

}  // namespace

std::vector<ReferencePlane> load_reference_planes(const std::filesystem::path& file) {
  std::vector<ReferencePlane> planes;
  for (const YAML::Node& node : YAML::LoadFile(file.string())["planes"]) {
    const Eigen::Vector3d normal = vector_of(node["normal"]);
    planes.push_back({node["name"].as<std::string>(),
                      {normal.normalized(), node["d"].as<double>() / normal.norm()},
                      vector_of(node["centroid"])});
  }
  return planes;
}

FeaturesOnReference features_on(const ReferencePlane& reference,
                                const std::vector<mapping::MapFeature>& map,
                                const ReferenceLimits& limits) {
  FeaturesOnReference found;
  found.name = reference.name;
  for (const mapping::MapFeature& feature : map) {
    const geometry::PlanarPolygon& surface = feature.surface;
    const double angle = geometry::degrees(geometry::angle_between(surface.plane, reference.plane));
    const double distance = std::abs(surface.plane.signed_distance(reference.centroid));
    const Eigen::Vector3d at = surface.frame.T_plane_parent() * reference.centroid;
    if (angle > limits.angle_deg || distance > limits.distance ||
        geometry::area(surface.polygon) < kLeastArea ||
        !geometry::contains(geometry::offset(surface.polygon, kAround), at.head<2>())) {
      continue;
    }
    found.features.push_back(&feature);
    found.angles_deg.push_back(angle);
    found.distances.push_back(distance);
  }
  if (found.features.empty()) return found;
  for (const mapping::MapFeature& other : map) {
    const double area = geometry::area(other.surface.polygon);
    if (&other == found.features[0] || area < kLeastArea) continue;
    if (logs::stacked_area(*found.features[0], other) > 0.2 * area) {
      found.stacked.push_back(to_string(other.id));
    }
  }
  return found;
}

std::ostream& operator<<(std::ostream& out, const FeaturesOnReference& found) {
  for (std::size_t i = 0; i < found.features.size(); ++i) {
    out << found.name << ": " << found.angles_deg[i] << " deg, " << 100.0 * found.distances[i]
        << " cm, " << geometry::area(found.features[i]->surface.polygon) << " m2, "
        << found.features[i]->observations.size() << " observations\n";
  }
  return out;
}

}  // namespace geomap::testing
