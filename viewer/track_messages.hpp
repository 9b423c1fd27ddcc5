// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>

#include "bot_core/rigid_transform_t.hpp"
#include "geomap/keyframe_t.hpp"
#include "geomap/keyframe_update_t.hpp"
#include "viewer/scene_model.hpp"
#include "viewer/taken.hpp"

namespace geomap::viewer {

/// @brief Where the camera has been, from what registration says.
class TrackUpdates {
 public:
  /// @brief CAMERA_POSE: T_world_camera. Poses are kept that differ from the last kept one.
  Taken take_pose(const bot_core::rigid_transform_t& message, TrackLayer& layer);
  /// @brief CAMERA_TO_BODY: T_body_camera.
  Taken take_camera_to_body(const bot_core::rigid_transform_t& message, TrackLayer& layer);
  /// @brief KEYFRAME: an accepted one has a place.
  Taken take_keyframe(const geomap::keyframe_t& message, TrackLayer& layer);
  /// @brief KEYFRAME_UPDATE: moved, taken out, and put in again.
  Taken take_update(const geomap::keyframe_update_t& message, TrackLayer& layer);

 private:
  std::map<std::int64_t, Eigen::Isometry3d> dropped_;  // that may come back: T_world_camera by id
};

}  // namespace geomap::viewer
