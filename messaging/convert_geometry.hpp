// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "bot_core/pose_t.hpp"
#include "bot_core/rigid_transform_t.hpp"
#include "geomap/camera_t.hpp"
#include "geomap/plane_frame_t.hpp"
#include "geomap/plane_set_t.hpp"
#include "geomap/plane_t.hpp"
#include "geomap/polygon_t.hpp"
#include "geomap/transform_t.hpp"
#include "geometry/camera_model.hpp"
#include "geometry/planar_polygon.hpp"

namespace geomap::messaging {

/// @brief T_parent_child as bot_core's types carry it, quaternion (w, x, y, z). Rounding only.
/// Velocities of the pose_t are zero.
bot_core::rigid_transform_t to_rigid_transform(std::int64_t utime, const Eigen::Isometry3d& T);
bot_core::pose_t to_pose(std::int64_t utime, const Eigen::Isometry3d& T_local_body);

/// @brief The inverse; the quaternion is normalised. @throws std::invalid_argument for a quaternion
/// that cannot be (safe_decode has refused those).
Eigen::Isometry3d from_message(const bot_core::rigid_transform_t& message);
Eigen::Isometry3d from_message(const bot_core::pose_t& message);

/// @brief T_parent_child as nine and three numbers: the same to the last bit after a round trip.
geomap::transform_t to_message(const Eigen::Isometry3d& T);
Eigen::Isometry3d from_message(const geomap::transform_t& message);

geomap::camera_t to_message(const geometry::CameraModel& camera);
geometry::CameraModel from_message(const geomap::camera_t& message);

/// @brief Rings on the 0.1 mm grid, as they are.
geomap::polygon_t to_message(const geometry::Polygon& polygon);
geometry::Polygon from_message(const geomap::polygon_t& message);

geomap::plane_frame_t to_message(const geometry::PlaneFrame& frame);
geometry::PlaneFrame from_message(const geomap::plane_frame_t& message);

/// @brief One observed plane, exact in every number.
geomap::plane_t to_message(const geometry::PlaneObservation& plane);

/// @brief The inverse; nothing when the frame's axes are not at right angles, a count or weight is
/// negative, or the polygon breaks its invariant: messages are not trusted.
std::optional<geometry::PlaneObservation> from_message(const geomap::plane_t& message);

/// @brief The planes of one key frame, as they travel from extraction to mapping.
struct PlaneSet {
  std::int64_t keyframe = 0;  // utime of the key frame [us], its id
  std::int64_t session = 0;   // of the publisher
  std::int64_t sequence = 0;  // counts the session's sets, from 0
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  double noise_factor = 1.0;  // of the depth noise model, as estimated for this frame
  std::vector<geometry::PlaneObservation> planes;  // camera frame
};

geomap::plane_set_t to_message(const PlaneSet& planes);
/// @brief The inverse; nothing when any of the planes is refused.
std::optional<PlaneSet> from_message(const geomap::plane_set_t& message);

}  // namespace geomap::messaging
