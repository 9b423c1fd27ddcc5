// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <span>
#include <vector>

#include "mapping/map_feature.hpp"

namespace geomap::mapping {

enum class SvgView { kTop, kFront, kOblique };

/// @brief Orthographic view of the world: unit axes of the picture and the looking direction.
struct ViewAxes {
  Eigen::Vector3d right;
  Eigen::Vector3d up;
  Eigen::Vector3d forward;  // away from the eye

  Eigen::Vector2d project(const Eigen::Vector3d& p) const { return {right.dot(p), up.dot(p)}; }
};

/// @brief Direction [rad, about z, 0 = +x] in which the front view looks: at the face of the
/// largest upright feature (within 15° of vertical), else along +y.
double front_heading(std::span<const MapFeature> features);

/// @brief Turn [rad] of the oblique view against the heading: 35° to the side from which more area
/// is seen from its front.
double oblique_turn(std::span<const MapFeature> features, double heading);

/// @brief Axes of a view. The top view has the heading upwards, so that it stands right above the
/// front view. The oblique one looks along heading + turn and 32° down.
ViewAxes view_axes(SvgView view, double heading, double turn);

/// @brief A feature in a view: coordinates along `right` and `up` [m].
struct ProjectedFeature {
  const MapFeature* feature = nullptr;
  std::size_t number = 0;  // in the order of the ids, from one
  std::vector<std::vector<Eigen::Vector2d>> rings;
  Eigen::AlignedBox2d box;
  double facing =
      0.0;             // cosine between normal and direction to the eye; negative: seen from behind
  double depth = 0.0;  // of the vertices' mean along `forward` [m]
};

/// @brief True for the back of a face; false for its front, and edge-on.
bool is_seen_from_behind(const ProjectedFeature& feature);

/// @brief All features with vertices, ascending by id.
std::vector<ProjectedFeature> project_features(std::span<const MapFeature> features,
                                               const ViewAxes& axes);

/// @brief Indices of `features` from the back to the front. Where one of two features that overlap
/// in the picture lies on one side of the other's plane, that decides; else, and in cycles, the
/// depth.
std::vector<std::size_t> paint_order(const std::vector<ProjectedFeature>& features);

}  // namespace geomap::mapping
