// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drivers/truth.hpp"
#include "logs/hull_distance.hpp"
#include "logs/plane_errors.hpp"
#include "logs/reference_surface.hpp"
#include "mapping/map_feature.hpp"

namespace geomap::logs {

/// @brief When a map feature belongs to a true surface, and what counts.
struct MapEvaluationRule {
  double min_area = 0.02;       // of a feature, and of a visible component [m²]
  double max_angle_deg = 25.0;  // between the normals: the same side
  double min_share = 0.5;       // of the feature's area that lies on the surface
  double gap = 0.03;            // visible parts closer than this are one component [m]
  // Of a reference whose outline nobody knows, at its centroid:
  double reference_distance = 0.15;  // from the feature's plane [m]
  double reference_reach = 0.15;     // beyond the feature's outline [m]
};

/// @brief How well one true surface is mapped. What cannot be measured is empty.
struct SurfaceEvaluation {
  std::string name;
  bool seen = false;
  bool counted = false;                // a visible component is large enough, or it is a reference
  std::size_t features = 0;            // that belong to it
  std::optional<PlaneErrors> errors;   // means over them
  std::optional<double> area;          // true, all of it [m²]
  std::optional<double> visible_area;  // true [m²]
  double map_area = 0.0;               // of the union of its features, on its plane [m²]
  std::optional<std::size_t> components;    // visible
  std::optional<double> intersection_area;  // of features and visible parts [m²]
  std::optional<double> union_area;         // of features and visible parts [m²]
  std::optional<HullDistance> hull_distance;

  std::optional<double> area_iou() const;
};

/// @brief A feature that belongs to no true surface.
struct FalseFeature {
  mapping::FeatureId id;
  double area = 0.0;  // [m²]
};

/// @brief How well a map shows what is there. What cannot be measured is empty.
struct MapEvaluation {
  std::size_t features_counted = 0;     // large enough
  std::size_t features_associated = 0;  // of them, with a surface they belong to
  std::optional<PlaneErrors> errors;    // means over the associated features
  std::optional<double> recall;         // surfaces found / surfaces that count
  /// Associated / counted features, and the features that are not. Empty with references whose
  /// outline nobody knows: the map then holds more than they do.
  std::optional<double> precision;
  std::optional<std::vector<FalseFeature>> false_features;  // by id
  std::optional<double> features_per_component;             // ideal: 1
  std::optional<double> area_iou;  // sum of intersections / sum of unions over surfaces that count
  std::optional<HullDistance> hull_distance;  // over all surfaces
  std::vector<SurfaceEvaluation> planes;      // in the order of the references
};

/// @brief Compares the features of a map with surfaces that are known. Every feature belongs to one
/// surface at most: of those that could be seen, whose normal is within the angle and that it
/// overlaps by enough of its own area, the one its vertices are nearest to.
MapEvaluation evaluate_map(std::span<const mapping::MapFeature> features,
                           std::span<const ReferenceSurface> references,
                           const MapEvaluationRule& rule = {});
MapEvaluation evaluate_map(std::span<const mapping::MapFeature> features,
                           const drivers::Truth& truth, const MapEvaluationRule& rule = {});

}  // namespace geomap::logs
