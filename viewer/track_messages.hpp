// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "bot_core/rigid_transform_t.hpp"
#include "geomap/keyframe_t.hpp"
#include "geomap/keyframe_update_t.hpp"
#include "viewer/scene_model.hpp"
#include "viewer/taken.hpp"

namespace geomap::viewer {

/// @brief Where the camera has been, from what registration says.
///
/// It begins anew when registration does: its first key frame is aligned to nothing, its clock is
/// an earlier one, or its point map is empty although there were key frames. A registration that
/// goes on with the state of its former run goes on here too.
class TrackUpdates {
 public:
  /// @brief CAMERA_POSE: T_world_camera. Poses are kept that differ from the last kept one. Late
  /// ones are left out; only several in a row say that the sender's clock is an earlier one.
  Taken take_pose(const bot_core::rigid_transform_t& message, TrackLayer& layer);
  /// @brief CAMERA_TO_BODY: T_body_camera.
  Taken take_camera_to_body(const bot_core::rigid_transform_t& message, TrackLayer& layer);
  /// @brief KEYFRAME: an accepted one has a place.
  Taken take_keyframe(const geomap::keyframe_t& message, TrackLayer& layer);
  /// @brief KEYFRAME_UPDATE: moved, taken out, and put in again.
  Taken take_update(const geomap::keyframe_update_t& message, TrackLayer& layer);

  /// @brief The point map is empty: after CLEAR, RESET, or a restart without the former state.
  /// @return true when there were key frames, which are gone now.
  bool note_empty_map(TrackLayer& layer);

 private:
  bool begins_anew(const geomap::keyframe_t& message) const;
  void clear(TrackLayer& layer);
  bool is_early(const TrackLayer::Pose& pose, TrackLayer& layer);

  struct Keyframe {
    std::int64_t session = 0, utime = 0;
    bool is_aligned = false;
  };
  std::optional<Keyframe> newest_;                     // accepted
  std::vector<TrackLayer::Pose> early_;                // earlier than the newest one, in a row
  std::map<std::int64_t, Eigen::Isometry3d> dropped_;  // that may come back: T_world_camera by id
};

}  // namespace geomap::viewer
