// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "mapping/map_feature.hpp"
#include "mapping/merge_config.hpp"

namespace geomap::mapping {

/// @brief Nothing smaller is drawn by hand or cut off [m²].
constexpr double kLeastDrawnArea = 1e-4;

/// @brief A polygon that was drawn by hand as a feature, whose evidence weighs as one close view.
/// @param corners world frame [m], counter-clockwise as seen from where the surface is visible
/// @return nothing when the corners lie farther than 5 cm off a plane, the polygon crosses itself
/// or it has less than `kLeastDrawnArea`.
std::optional<MapFeature> drawn_feature(const FeatureId& id,
                                        std::span<const Eigen::Vector3d> corners,
                                        const MergeConfig& config);

/// @brief The corners dropped along the normal of a frame; empty when they enclose nothing there.
geometry::Polygon drawn_in_frame(std::span<const Eigen::Vector3d> corners,
                                 const geometry::PlaneFrame& frame);

/// @brief The half plane to the left of the line from p to q, as far as `extent` reaches, seen
/// against the frame's normal; empty when the line has no length there.
geometry::Polygon left_of(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                          const geometry::PlaneFrame& frame, const geometry::Polygon& extent);

}  // namespace geomap::mapping
