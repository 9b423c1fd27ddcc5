// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>

#include "geomap/rgbd_frame_t.hpp"
#include "viewer/scene_model.hpp"

namespace geomap::viewer {

/// @brief The newest camera frame: kept as it came until it is to be seen, because decoding costs
/// more than all else.
class NewestFrame {
 public:
  /// @param channel that it came on. @param T_world_camera where it was taken, as far as known.
  void offer(const std::string& channel, const geomap::rgbd_frame_t& message,
             const std::optional<Eigen::Isometry3d>& T_world_camera);

  /// @brief Decodes the newest frame and says where it was taken: by itself, or within 0.1 s by
  /// the camera's newest pose. One that cannot be decoded is counted as refused.
  /// @return true when the frame layer has changed.
  bool show(SceneModel& scene);

 private:
  bool decode(SceneModel& scene);
  bool place(SceneModel& scene);

  struct Waiting {
    std::string channel;
    geomap::rgbd_frame_t message;
  };
  std::optional<Waiting> waiting_;
  std::optional<std::int64_t> newest_;               // utime [us]
  std::optional<Eigen::Isometry3d> T_world_camera_;  // of the newest, by itself
  std::optional<std::int64_t> away_;  // of the pose that the frame has got, in time [us]
};

}  // namespace geomap::viewer
