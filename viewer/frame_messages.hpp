// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "geomap/rgbd_frame_t.hpp"
#include "viewer/scene_model.hpp"

namespace geomap::viewer {

/// @brief The last few camera frames, each kept as it came until it is to be seen, because decoding
/// costs more than all else. A frame comes before its pose, which is worked out from it.
class RecentFrames {
 public:
  /// @param channel that it came on. @param T_world_camera where it was taken, as far as known.
  void offer(const std::string& channel, const geomap::rgbd_frame_t& message,
             const std::optional<Eigen::Isometry3d>& T_world_camera);
  /// @brief Where the camera was at a time [us].
  void note_pose(std::int64_t utime, const Eigen::Isometry3d& T_world_camera);

  /// @brief Decodes the newest frame, and the newest one of which it is known where it was taken:
  /// from its own pose, or from two poses, before and after it, within 0.1 s. Until there is a
  /// newer one the former stays. One that cannot be decoded is counted as refused.
  /// @return true when the frame layer has changed.
  bool show(SceneModel& scene);

 private:
  struct Frame {
    std::string channel;
    geomap::rgbd_frame_t message;
    std::shared_ptr<const geometry::RgbdFrame> decoded;  // once it was to be seen
    std::optional<Eigen::Isometry3d> T_world_camera;
  };
  using Frames = std::map<std::int64_t, Frame>;  // by utime [us]

  bool show_newest(SceneModel& scene);
  bool show_placed(SceneModel& scene);
  bool decode(Frame& frame, SceneModel& scene) const;
  std::optional<Eigen::Isometry3d> pose_at(std::int64_t utime) const;

  Frames frames_;
  std::map<std::int64_t, Eigen::Isometry3d> poses_;          // T_world_camera by utime [us]
  std::optional<std::int64_t> shown_newest_, shown_placed_;  // utime [us]
};

}  // namespace geomap::viewer
