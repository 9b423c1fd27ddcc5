// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/paper_merger.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "geometry/polygon_clip.hpp"
#include "mapping/fuse.hpp"

namespace geomap::mapping {
namespace {

using geometry::Plane;

Plane on_side_of(const Plane& plane, const Plane& reference) {
  return plane.normal.dot(reference.normal) < 0.0 ? plane.flipped() : plane;
}

// Equations 6a and 6b.
bool coefficients_agree(const MapFeature& a, const MapFeature& b, const MergeConfig& config) {
  const Plane plane_a = a.surface.plane;
  const Plane plane_b = on_side_of(b.surface.plane, plane_a);
  return plane_a.normal.dot(plane_b.normal) > config.paper_cosine &&
         std::abs(plane_a.d - plane_b.d) < config.paper_distance;
}

bool intersects(const MapFeature& a, const MapFeature& b) {
  return !geometry::intersect(a.surface.polygon, b.surface.in_frame(a.surface.frame)).empty();
}

// Equation 7; the weights are the numbers of merged observations.
Plane averaged(const MapFeature& a, const MapFeature& b) {
  const Plane plane_b = on_side_of(b.surface.plane, a.surface.plane);
  const auto weight_a = static_cast<double>(a.observations.size());
  const auto weight_b = static_cast<double>(b.observations.size());
  const Eigen::Vector3d normal = weight_a * a.surface.plane.normal + weight_b * plane_b.normal;
  const double length = normal.norm();
  return {normal / length, (weight_a * a.surface.plane.d + weight_b * plane_b.d) / length};
}

double rms_about(const geometry::PlaneMoments& moments, const Plane& plane) {
  const Eigen::Vector3d mean = moments.centroid();
  const Eigen::Matrix3d scatter = moments.second / moments.weight - mean * mean.transpose();
  const double offset = plane.signed_distance(mean);
  return std::sqrt(std::max(0.0, plane.normal.dot(scatter * plane.normal)) + offset * offset);
}

}  // namespace

std::int64_t PaperMerger::insert(MapFeature feature, FeatureStore& store) const {
  const auto compared = static_cast<std::int64_t>(store.features().size());
  std::vector<FeatureId> candidates;
  for (const auto& [id, other] : store.features()) {  // d at the origin says nothing of nearness
    if (!other->is_held() && coefficients_agree(feature, *other, config_) &&
        intersects(feature, *other)) {
      candidates.push_back(id);
    }
  }
  for (const FeatureId& id : candidates) {
    const MapFeature other = store.at(id);
    store.erase(id);
    feature = other.id < feature.id ? merge(other, feature) : merge(feature, other);
  }
  store.put(std::move(feature));
  return compared;
}

MapFeature PaperMerger::merge(const MapFeature& older, const MapFeature& younger) const {
  MapFeature merged = older;
  geometry::PlanarPolygon& surface = merged.surface;
  add_evidence(merged, younger);
  refit(merged);  // for the uncertainty; the plane is the paper's

  surface.plane = averaged(older, younger);
  surface.frame =
      geometry::PlaneFrame::on(surface.plane, older.surface.frame.origin,
                               older.surface.frame.x_axis, older.surface.frame.y_axis());
  const Eigen::Isometry3d T_new_old =
      surface.frame.T_plane_parent() * older.surface.frame.T_parent_plane();
  merged.moments = merged.moments.transformed(T_new_old);
  merged.rms = rms_about(merged.moments, surface.plane.transformed(surface.frame.T_plane_parent()));
  surface.polygon = geometry::unite(older.surface.in_frame(surface.frame),
                                    younger.surface.in_frame(surface.frame));  // equation 11
  return merged;
}

}  // namespace geomap::mapping
