// SPDX-License-Identifier: BSD-3-Clause
#include "logs/map_evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/angles.hpp"
#include "geometry/polygon_clip.hpp"
#include "mapping/export_features.hpp"

namespace geomap::logs {
namespace {

using geometry::Polygon;

/// No outline reaches this far from its frame, and the coordinates of a frame end at 100 km.
constexpr double kOutOfReach = 5e4;  // [m]

/// A feature that belongs to a surface.
struct Match {
  const mapping::MapFeature* feature = nullptr;
  Polygon projected;   // onto the surface, in its frame; empty for a reference without outline
  Eigen::Vector3d at;  // of the surface's plane, in the middle of what both cover [m]
};

std::optional<double> ratio(double part, double whole) {
  return whole > 0.0 ? std::optional(part / whole) : std::nullopt;
}

std::optional<double> ratio(std::size_t part, std::size_t whole) {
  return ratio(static_cast<double>(part), static_cast<double>(whole));
}

bool reaches(const geometry::PlanarPolygon& surface, const Eigen::Vector3d& centroid,
             const MapEvaluationRule& rule) {
  if (std::abs(surface.plane.signed_distance(centroid)) > rule.reference_distance) return false;
  const Eigen::Vector3d at = surface.frame.T_plane_parent() * centroid;
  return geometry::contains(geometry::offset(surface.polygon, rule.reference_reach), at.head<2>());
}

/// Whether, and where, a feature lies on a surface whose normal it shares.
std::optional<Match> match(const mapping::MapFeature& feature, const ReferenceSurface& reference,
                           const MapEvaluationRule& rule) {
  if (reference.centroid) {
    if (!reaches(feature.surface, *reference.centroid, rule)) return std::nullopt;
    return Match{&feature, {}, reference.plane.project(*reference.centroid)};
  }
  if ((feature.surface.frame.origin - reference.frame.origin).norm() > kOutOfReach) {
    return std::nullopt;
  }
  Polygon projected = feature.surface.in_frame(reference.frame);
  const geometry::AreaMoments overlap =
      geometry::area_moments(geometry::intersect(projected, reference.outline));
  if (overlap.area == 0.0 || overlap.area < rule.min_share * geometry::area(projected)) {
    return std::nullopt;
  }
  const Eigen::Vector3d at(overlap.centroid.x(), overlap.centroid.y(), 0.0);
  return Match{&feature, std::move(projected), reference.frame.T_parent_plane() * at};
}

/// The surface a feature belongs to goes into `matches`. @return false for a false feature.
bool associate(const mapping::MapFeature& feature, std::span<const ReferenceSurface> references,
               const MapEvaluationRule& rule, std::vector<std::vector<Match>>& matches) {
  const double max_angle = geometry::radians(rule.max_angle_deg);
  double nearest = std::numeric_limits<double>::infinity();
  std::optional<Match> best;
  std::size_t best_index = 0;
  for (std::size_t i = 0; i < references.size(); ++i) {
    const ReferenceSurface& reference = references[i];
    if (!reference.seen) continue;
    if (geometry::angle_between(feature.surface.plane, reference.plane) > max_angle) continue;
    const double rms = vertex_rms(feature.surface, reference.plane);
    if (!(rms < nearest)) continue;
    if (auto found = match(feature, reference, rule)) {
      nearest = rms;
      best = std::move(found);
      best_index = i;
    }
  }
  if (best) matches[best_index].push_back(std::move(*best));
  return best.has_value();
}

std::vector<PlaneErrors> errors_of(const ReferenceSurface& reference,
                                   const std::vector<Match>& matches) {
  std::vector<PlaneErrors> errors;
  for (const Match& match : matches) {
    errors.push_back(plane_errors(match.feature->surface, reference.plane, match.at));
  }
  return errors;
}

void measure_areas(const ReferenceSurface& reference, const std::vector<Match>& matches,
                   const MapEvaluationRule& rule, SurfaceEvaluation& result) {
  std::vector<Polygon> parts;
  for (const Match& match : matches) parts.push_back(match.projected);
  const Polygon mapped = geometry::unite(parts);
  result.area = geometry::area(reference.outline);
  result.visible_area = geometry::area(reference.visible);
  result.map_area = geometry::area(mapped);
  result.components = visible_components(reference, rule.gap, rule.min_area);
  result.intersection_area = geometry::area(geometry::intersect(mapped, reference.visible));
  result.union_area = geometry::area(geometry::unite(mapped, reference.visible));
  result.hull_distance = hull_distance(parts, reference.visible);
}

SurfaceEvaluation evaluate_surface(const ReferenceSurface& reference,
                                   const std::vector<Match>& matches,
                                   const MapEvaluationRule& rule) {
  SurfaceEvaluation result;
  result.name = reference.name;
  result.seen = reference.seen;
  result.features = matches.size();
  if (!matches.empty()) result.errors = mean_of(errors_of(reference, matches));
  if (reference.centroid) {
    for (const Match& match : matches) {
      result.map_area += geometry::area(match.feature->surface.polygon);
    }
  } else {
    measure_areas(reference, matches, rule, result);
  }
  result.counted = reference.seen && (reference.centroid || *result.components > 0);
  return result;
}

/// Figures over all surfaces, from those of each.
void sum_up(MapEvaluation& evaluation) {
  std::size_t wanted = 0, found = 0, components = 0, features_on_components = 0;
  double intersection = 0.0, whole = 0.0;
  HullDistance hull;
  for (const SurfaceEvaluation& plane : evaluation.planes) {
    if (plane.counted) {
      ++wanted;
      if (plane.features > 0) ++found;
      if (plane.components) {
        components += *plane.components;
        features_on_components += plane.features;
      }
      intersection += plane.intersection_area.value_or(0.0);
      whole += plane.union_area.value_or(0.0);
    }
    hull = joined(hull, plane.hull_distance.value_or(HullDistance{}));
  }
  evaluation.recall = ratio(found, wanted);
  evaluation.features_per_component = ratio(features_on_components, components);
  evaluation.area_iou = ratio(intersection, whole);
  if (hull.vertices > 0) evaluation.hull_distance = hull;
}

}  // namespace

std::optional<double> SurfaceEvaluation::area_iou() const {
  if (!intersection_area || !union_area) return std::nullopt;
  return ratio(*intersection_area, *union_area);
}

MapEvaluation evaluate_map(std::span<const mapping::MapFeature> features,
                           std::span<const ReferenceSurface> references,
                           const MapEvaluationRule& rule) {
  MapEvaluation evaluation;
  std::vector<std::vector<Match>> matches(references.size());
  std::vector<FalseFeature> unknown;
  for (const mapping::MapFeature* feature : mapping::sorted_by_id(features)) {
    const double area = geometry::area(feature->surface.polygon);
    if (area < rule.min_area) continue;
    ++evaluation.features_counted;
    if (!associate(*feature, references, rule, matches)) unknown.push_back({feature->id, area});
  }
  evaluation.features_associated = evaluation.features_counted - unknown.size();

  std::vector<PlaneErrors> errors;
  for (std::size_t i = 0; i < references.size(); ++i) {
    evaluation.planes.push_back(evaluate_surface(references[i], matches[i], rule));
    const std::vector<PlaneErrors> more = errors_of(references[i], matches[i]);
    errors.insert(errors.end(), more.begin(), more.end());
  }
  if (!errors.empty()) evaluation.errors = mean_of(errors);
  sum_up(evaluation);

  const bool all_known = std::none_of(references.begin(), references.end(),
                                      [](const auto& r) { return r.centroid.has_value(); });
  if (all_known) {
    evaluation.precision = ratio(evaluation.features_associated, evaluation.features_counted);
    evaluation.false_features = std::move(unknown);
  }
  return evaluation;
}

MapEvaluation evaluate_map(std::span<const mapping::MapFeature> features,
                           const drivers::Truth& truth, const MapEvaluationRule& rule) {
  return evaluate_map(features, reference_surfaces(truth), rule);
}

}  // namespace geomap::logs
