// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "mapping/map_event.hpp"
#include "mapping/map_feature.hpp"
#include "mapping/merge_config.hpp"

namespace geomap::mapping {

/// @brief Variance [m²] of the offset of one view of a surface: the camera's pose, and the part of
/// the sensor's error that is the same all over the view. Taken from the moments' own noise term,
/// so it grows with depth as the sensor's noise does.
double view_variance(const geometry::PlaneMoments& moments, const MergeConfig& config);

/// @brief One observed plane as a feature of its own, in the world: moments in the plane frame,
/// scaled so that one view weighs at most
/// 1/view_variance, and less where it covers little surface. Nothing when the view is too oblique
/// to decide the plane's side (|n·ray| below the limit) or its moments span no plane.
std::optional<MapFeature> feature_of(const Observation& observation, std::int32_t plane_number,
                                     const MergeConfig& config);

/// @brief Adds what `other` has to `feature`: moments, observations, inliers, colour, labels.
/// Leaves plane and outline alone. `other`'s frame may differ.
void add_evidence(MapFeature& feature, const MapFeature& other);

/// @brief Plane, rms and uncertainty from the feature's moments. @return false, and the feature as
/// it was, where the moments span no plane.
bool refit(MapFeature& feature);

/// @brief Moves the polygon's frame onto the plane when the plane has turned against it or the
/// frame's origin has left the polygon's bounding box (numbers stay small far from the world's
/// origin).
void rebase_where_needed(MapFeature& feature, double angle_limit);

/// @brief Union of two outlines of one frame that does not creep: only where `added` reaches more
/// than `tolerance` [m] beyond `old_outline` is its area added, and only new vertices are
/// simplified, within the same error. So a thousand noisy views of one border leave it where the
/// first one put it, give or take the tolerance, instead of at the outermost of all.
geometry::Polygon united_outline(const geometry::Polygon& old_outline,
                                 const geometry::Polygon& added, double tolerance);

}  // namespace geomap::mapping
