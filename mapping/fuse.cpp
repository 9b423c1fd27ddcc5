// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fuse.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <set>
#include <string>

#include "geometry/polygon_clip.hpp"
#include "geometry/polygon_simplify.hpp"

namespace geomap::mapping {
namespace {

using geometry::GridPoint;
using geometry::PlaneFrame;
using geometry::Polygon;

constexpr std::array<double, 3> kNoColor{};

// Without parts that no disc of this diameter fits in.
Polygon without_slivers(Polygon polygon, double diameter) {
  std::erase_if(polygon.parts, [&](const geometry::PolygonPart& part) {
    return geometry::signed_area(part.outer) < 0.25 * std::numbers::pi * diameter * diameter;
  });
  return polygon;
}

// Most that one view may weigh [1/m²]. Its offset is no better than the camera's pose, however many
// pixels it has; and a patch weighs no more than its share of surface, or else a few small ones at
// the rim, each off by what the camera's systematic errors allow, would turn a large plane.
double view_weight(const geometry::PlaneObservation& seen, const MergeConfig& config) {
  const double share =
      std::min(1.0, geometry::area(seen.surface.polygon) / config.full_weight_area);
  return share / view_variance(seen.moments, config);
}

// The operator's last word counts; what it overrules is not lost.
void add_labels(MapFeature& feature, const MapFeature& other) {
  std::set<std::string> all(feature.other_labels.begin(), feature.other_labels.end());
  all.insert(other.other_labels.begin(), other.other_labels.end());
  for (const std::string& label : {feature.label, other.label}) {
    if (!label.empty()) all.insert(label);
  }
  if (other.label_edit > feature.label_edit) {
    feature.label = other.label;
    feature.label_edit = other.label_edit;
  }
  all.erase(feature.label);
  feature.other_labels.assign(all.begin(), all.end());
}

}  // namespace

double view_variance(const geometry::PlaneMoments& moments, const MergeConfig& config) {
  const double sensor_variance = moments.noise.trace() / moments.weight;
  return config.sigma_pose * config.sigma_pose +
         config.systematic_share * config.systematic_share * sensor_variance;
}

std::optional<MapFeature> feature_of(const Observation& observation, std::int32_t plane_number,
                                     const MergeConfig& config) {
  const geometry::PlaneObservation& seen =
      observation.planes[static_cast<std::size_t>(plane_number)];
  const Eigen::Vector3d ray = seen.moments.centroid().normalized();
  if (std::abs(seen.surface.plane.normal.dot(ray)) < config.min_view_cosine) return std::nullopt;

  MapFeature feature;
  feature.id = {observation.keyframe, plane_number};
  feature.observations = {feature.id};
  feature.surface = seen.surface.transformed(observation.T_world_camera);
  feature.moments = seen.moments.transformed(seen.surface.frame.T_plane_parent())
                        .capped(view_weight(seen, config));
  feature.inliers = seen.inliers;
  feature.color = seen.color;
  if (!refit(feature)) return std::nullopt;
  return feature;
}

void add_evidence(MapFeature& feature, const MapFeature& other) {
  const Eigen::Isometry3d T_feature_other =
      feature.surface.frame.T_plane_parent() * other.surface.frame.T_parent_plane();
  feature.moments += other.moments.transformed(T_feature_other);

  std::vector<ObservationId> all;
  std::merge(feature.observations.begin(), feature.observations.end(), other.observations.begin(),
             other.observations.end(), std::back_inserter(all));
  feature.observations = std::move(all);
  feature.id = feature.observations.front();

  const double total = static_cast<double>(feature.inliers + other.inliers);
  double share = static_cast<double>(other.inliers) / total;
  if (other.color == kNoColor) share = 0.0;  // seen without colour, not seen black
  if (feature.color == kNoColor) share = 1.0;
  for (std::size_t i = 0; i < feature.color.size(); ++i) {
    feature.color[i] += share * (other.color[i] - feature.color[i]);
  }
  feature.inliers += other.inliers;
  add_labels(feature, other);
}

bool refit(MapFeature& feature) {
  const auto fit = feature.moments.fit(Eigen::Vector3d::UnitZ());
  if (!fit) return false;
  feature.surface.plane = fit->plane.transformed(feature.surface.frame.T_parent_plane());
  feature.rms = fit->rms;
  feature.sigma_angle = fit->sigma_angle();
  feature.sigma_d = fit->sigma_offset(fit->centroid);
  return true;
}

void rebase_where_needed(MapFeature& feature, double angle_limit) {
  geometry::PlanarPolygon& surface = feature.surface;
  const bool turned = geometry::angle_between(surface.plane, surface.frame.plane()) > angle_limit;
  const Eigen::AlignedBox2d box = geometry::bounding_box(surface.polygon);
  if (!turned && box.contains(Eigen::Vector2d::Zero())) return;

  const Eigen::Vector3d near = surface.lift(Eigen::Vector2d(box.center()));
  const PlaneFrame frame =
      PlaneFrame::on(surface.plane, near, surface.frame.x_axis, surface.frame.y_axis());
  feature.moments =
      feature.moments.transformed(frame.T_plane_parent() * surface.frame.T_parent_plane());
  surface.polygon = surface.in_frame(frame);
  surface.frame = frame;
}

Polygon united_outline(const Polygon& old_outline, const Polygon& added, double tolerance) {
  // What is left of the excess when half the tolerance is worn off on each side is where it counts.
  const Polygon excess = without_slivers(geometry::subtract(added, old_outline), tolerance);
  const Polygon core = geometry::offset(excess, -0.5 * tolerance);
  if (core.empty()) return old_outline;
  // Grown back, and by as much again so that it overlaps the old outline.
  const Polygon extension = geometry::intersect(added, geometry::offset(core, 1.5 * tolerance));
  const Polygon both = geometry::unite(old_outline, extension);
  std::vector<GridPoint> old_vertices = geometry::vertices(old_outline);
  std::sort(old_vertices.begin(), old_vertices.end());
  return geometry::simplify(both, tolerance, [&](GridPoint vertex) {
    return std::binary_search(old_vertices.begin(), old_vertices.end(), vertex);
  });
}

}  // namespace geomap::mapping
