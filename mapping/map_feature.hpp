// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/planar_polygon.hpp"
#include "geometry/plane_moments.hpp"

namespace geomap::mapping {

/// @brief Names one plane of one key frame. Ordered by age.
struct ObservationId {
  std::int64_t keyframe = 0;  // the key frame's utime [us]
  std::int32_t plane = 0;     // number within the key frame
  auto operator<=>(const ObservationId&) const = default;
};

/// @brief A feature is named after its oldest observation, so its id does not depend on what else
/// the camera saw. When features merge, the smallest id stays.
using FeatureId = ObservationId;

/// @brief "KEYFRAME-PLANE", for example "1000000000033333-2".
std::string to_string(const FeatureId& id);

/// @brief One planar surface of the geometric map. World frame (z up), metres.
struct MapFeature {
  FeatureId id;
  geometry::PlanarPolygon surface;          // frame's parent: world
  geometry::PlaneMoments moments;           // in the coordinates of surface.frame, each view capped
  std::vector<ObservationId> observations;  // what was fused, ascending; the first one is the id
  std::int64_t inliers = 0;                 // pixels of all observations
  double rms = 0.0;                         // of the points about the plane [m]
  double sigma_angle = 0.0;                 // of the normal [rad]
  double sigma_d = 0.0;                     // of the offset at the centroid [m]
  std::array<double, 3> color{};            // mean red, green, blue, 0..255, weighted by inliers
  std::string label;                        // given by the operator; empty: none
  std::int64_t label_edit = 0;              // number of the edit that gave it; 0: none
  std::vector<std::string> other_labels;    // overruled by a later one in a merge, ascending
  std::vector<std::int64_t> held_by;        // edits that hold it, ascending; see is_held()

  /// @brief Held by the operator: observations and merging leave it alone.
  bool is_held() const { return !held_by.empty(); }
  std::int64_t first_utime() const { return observations.front().keyframe; }
  std::int64_t last_utime() const { return observations.back().keyframe; }
};

}  // namespace geomap::mapping
