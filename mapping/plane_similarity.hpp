// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "geometry/polygon.hpp"
#include "mapping/clip_memo.hpp"
#include "mapping/map_feature.hpp"
#include "mapping/merge_config.hpp"

namespace geomap::mapping {

/// @brief The first condition that keeps two features apart.
enum class Difference {
  kNone,      // the same surface
  kSide,      // seen from opposite sides: a thin door stays two planes
  kAngle,     // angle between the normals beyond the gate
  kOverlap,   // too little overlap, even with the gap tolerance
  kDistance,  // planes too far apart where the polygons overlap
};

/// @brief How alike two features are, measured where their polygons are.
struct Similarity {
  Difference difference = Difference::kNone;
  double angle = 0.0;     // [rad]
  double overlap = 0.0;   // area of the overlap, the smaller one grown by the gap tolerance [m²]
  double distance = 0.0;  // rms distance between the planes over the overlap [m]
  geometry::Polygon b_in_a;  // b's polygon in a's frame, set once side and angle agree
};

/// @brief Decides whether two features are one surface. Gates come from the uncertainty of both,
/// within the bounds of `config`: the angle at most 3 combined sigma_angle; the rms distance over
/// the overlap at most 3 sqrt(sigma_a² + sigma_b² + v_a + v_b), where v is the variance that every
/// single view has (view_variance: pose and sensor) and that no averaging removes. Replaces
/// equation 6 of the paper, which compares d at the world's origin: there a 3° error 8 m away reads
/// as 0.4 m. The result does not depend on where the world's origin is.
/// @param overlap_to_beat [m²] pairs whose boxes tell that they overlap by less are kOverlap
/// without a closer look.
Similarity compare(const MapFeature& a, const MapFeature& b, const MergeConfig& config,
                   ClipMemo& memo, double overlap_to_beat = 0.0);

/// @brief The largest distance [m] between the planes of two views at which they may be one
/// surface, however uncertain their fits are.
double merging_reach(const MapFeature& a, const MapFeature& b, const MergeConfig& config);

/// @brief Rms over an area of the distance [m] between two planes, both given in the area's frame.
double rms_distance(const geometry::Plane& a, const geometry::Plane& b,
                    const geometry::AreaMoments& over);

}  // namespace geomap::mapping
