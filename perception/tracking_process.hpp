// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <utility>

#include "geomap/rgbd_frame_t.hpp"
#include "geometry/rgbd_frame.hpp"
#include "messaging/config.hpp"
#include "perception/tracker.hpp"

namespace geomap::perception {

/// @brief The settings of registration. @throws messaging::ConfigError.
TrackerConfig read_tracker_config(const messaging::Config& config);

/// @brief A frame that has been tracked.
struct TrackedFrame {
  geomap::rgbd_frame_t message;
  Tracked tracked;
  std::optional<geometry::RgbdFrame> image;                        // where it was needed
  Eigen::Isometry3d T_world_odom = Eigen::Isometry3d::Identity();  // as it is then
  double decode_seconds = 0.0;
  double registration_seconds = 0.0;  // with the insertion into the point map
};

/// @brief Registration without a network: poses and frames in the order of their arrival. Each
/// frame waits until its prior is ready, then it is tracked. The state is a function of the input
/// alone.
class TrackingProcess {
 public:
  /// @brief Called for each frame once it has been tracked.
  using Listener = std::function<void(TrackedFrame)>;

  /// @throws std::invalid_argument when a setting is not valid.
  TrackingProcess(const TrackerConfig& config, Listener listener)
      : config_(config), tracker_(config), listener_(std::move(listener)) {}

  void add_pose(std::int64_t utime, const Eigen::Isometry3d& T_odom_body);
  void add_camera_to_body(std::int64_t utime, const Eigen::Isometry3d& T_body_camera);
  void add_frame(geomap::rgbd_frame_t message);
  /// @brief Tracks what still waits for a prior. Call at the end of the input.
  void finish();
  /// @brief Forgets everything: the next frame is the first one.
  void reset();

  std::int64_t frames() const { return frames_; }
  Tracker& tracker() { return tracker_; }
  const Tracker& tracker() const { return tracker_; }

 private:
  void track_ready();
  void track_next();

  TrackerConfig config_;
  Tracker tracker_;
  Listener listener_;
  std::deque<geomap::rgbd_frame_t> waiting_;  // for their prior
  std::int64_t frames_ = 0;
};

}  // namespace geomap::perception
