// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "perception/pose_buffer.hpp"

namespace geomap::perception {

/// @brief Where the prior of a frame's pose comes from.
struct PriorConfig {
  std::string kind = "odometry";  // "odometry": POSE is T_odom_body; "localisation": T_world_body
  double max_gap = 0.1;           // longest time bridged between poses, or waited for one [s]
  double jump_distance = 0.3;     // more than this within max_gap is a jump [m]
  double jump_angle_deg = 45.0;   // the same for rotation [deg]
  /// T_body_camera where no CAMERA_TO_BODY says otherwise: x, y, z [m], and (w, x, y, z). The
  /// default is a camera at the body's origin that looks along the body's x, level.
  std::vector<double> camera_position = {0.0, 0.0, 0.0};
  std::vector<double> camera_quaternion = {0.5, -0.5, 0.5, -0.5};

  std::vector<std::string> validate() const;

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& visitor) {
    visitor("kind", self.kind);
    visitor("max_gap", self.max_gap);
    visitor("jump_distance", self.jump_distance);
    visitor("jump_angle_deg", self.jump_angle_deg);
    visitor("camera_position", self.camera_position);
    visitor("camera_quaternion", self.camera_quaternion);
  }
};

/// @brief How a prior was found, or why there is none.
enum class PriorReason {
  kInterpolated,  // between two poses, or exactly at one
  kExtrapolated,  // constant velocity of the two nearest poses of one side
  kHeld,          // one pose near enough, but no velocity known: taken as it is
  kNoPose,        // none: no POSE has arrived
  kPoseTooOld,    // none: the newest POSE is more than max_gap before the frame
  kPoseTooNew,    // none: the oldest POSE kept is more than max_gap after the frame
  kPoseGap,       // none: the frame lies in a gap of POSE, more than max_gap from either end
};

/// @brief Stable name for reports and messages, for example "pose_too_old".
std::string_view to_string(PriorReason reason);

/// @brief The prior of one frame. Both transforms are present, or neither.
struct Prior {
  PriorReason reason = PriorReason::kNoPose;
  std::optional<Eigen::Isometry3d> T_world_camera;
  /// The same before T_world_odom: a registration that finds the camera at T_world_camera updates
  /// T_world_odom = T_world_camera · T_odom_camera⁻¹.
  std::optional<Eigen::Isometry3d> T_odom_camera;
};

/// @brief Turns the streams POSE and CAMERA_TO_BODY into priors for the poses of frames:
/// T_world_camera = T_world_odom · POSE · T_body_camera. Time is the sensors' utime alone; messages
/// come in the order of arrival, and the answers depend on nothing else.
///
/// POSE is interpolated over at most max_gap, else extrapolated at constant velocity over at most
/// max_gap, and never across a jump. CAMERA_TO_BODY is interpolated in the same way, but else its
/// last value holds however old it is, because a neck that stands still need not say so; before its
/// first value, that value is used when at most max_gap away, else the transform of the
/// configuration.
class PosePrior {
 public:
  /// @throws std::invalid_argument when the configuration is not valid.
  explicit PosePrior(const PriorConfig& config = {});

  /// @brief POSE: T_odom_body, or T_world_body for localisation. What is not rigid, or has an
  /// impossible utime, is ignored and counted.
  void add_pose(std::int64_t utime, const Eigen::Isometry3d& T_odom_body);

  /// @brief CAMERA_TO_BODY: T_body_camera.
  void add_camera_to_body(std::int64_t utime, const Eigen::Isometry3d& T_body_camera);

  /// @brief The utime of any other input message; call it for each frame before is_ready().
  /// @throws std::invalid_argument here and below for a utime that is negative or beyond 2^62.
  void note_input(std::int64_t utime);

  /// @brief True when waiting longer for a better prior makes no sense: a POSE at or after the
  /// frame has arrived, or any input max_gap after it, or the inputs have restarted at an earlier
  /// time.
  bool is_ready(std::int64_t frame_utime) const;

  /// @brief The prior from what has arrived so far. May be asked before is_ready(), as at the end
  /// of a log.
  Prior prior_at(std::int64_t frame_utime) const;

  /// @brief T_body_camera by CAMERA_TO_BODY or the configuration.
  Eigen::Isometry3d T_body_camera_at(std::int64_t utime) const;

  /// @brief The correction of the odometry's drift, identity at first. No effect on localisation.
  /// @throws std::invalid_argument unless it is rigid.
  void set_T_world_odom(const Eigen::Isometry3d& T_world_odom);
  const Eigen::Isometry3d& T_world_odom() const { return T_world_odom_; }

  const PoseBufferCounts& pose_counts() const { return poses_.counts(); }
  const PoseBufferCounts& camera_to_body_counts() const { return necks_.counts(); }

 private:
  void advance_clock(std::int64_t utime, bool restarted);

  PriorConfig config_;
  Eigen::Isometry3d T_body_camera_fixed_;
  Eigen::Isometry3d T_world_odom_ = Eigen::Isometry3d::Identity();
  PoseBuffer poses_;
  PoseBuffer necks_;
  std::optional<std::int64_t> clock_;       // newest utime of any input
  std::optional<std::int64_t> last_input_;  // newest utime given to note_input()
};

}  // namespace geomap::perception
