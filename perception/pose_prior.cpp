// SPDX-License-Identifier: BSD-3-Clause
#include "perception/pose_prior.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/angles.hpp"
#include "perception/rigid_transform.hpp"

namespace geomap::perception {
namespace {

std::int64_t max_gap_us(const PriorConfig& config) {
  return static_cast<std::int64_t>(std::llround(config.max_gap * 1e6));
}

PoseBufferLimits limits_of(const PriorConfig& config) {
  return {max_gap_us(config), config.jump_distance, geometry::radians(config.jump_angle_deg)};
}

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

/// Only for sizes that validate() has checked.
Eigen::Quaterniond camera_quaternion_of(const PriorConfig& config) {
  const auto& q = config.camera_quaternion;
  return {q[0], q[1], q[2], q[3]};
}

const PriorConfig& validated(const PriorConfig& config) {
  const auto errors = config.validate();
  if (!errors.empty()) throw std::invalid_argument("prior: " + errors.front());
  return config;
}

Eigen::Isometry3d fixed_T_body_camera(const PriorConfig& config) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = camera_quaternion_of(config).normalized().toRotationMatrix();
  T.translation() = Eigen::Vector3d::Map(config.camera_position.data());
  return T;
}

PriorReason reason_of(PoseBuffer::Source source) {
  switch (source) {
    case PoseBuffer::Source::kInterpolated:
      return PriorReason::kInterpolated;
    case PoseBuffer::Source::kExtrapolated:
      return PriorReason::kExtrapolated;
    case PoseBuffer::Source::kHeld:
      return PriorReason::kHeld;
  }
  throw std::invalid_argument("no such source of a pose");
}

void require_valid(std::int64_t utime) {
  if (!is_valid_utime(utime)) throw std::invalid_argument("prior: utime out of range");
}

PriorReason why_none(const PoseBuffer& poses, std::int64_t frame_utime) {
  if (poses.empty()) return PriorReason::kNoPose;
  if (poses.newest_utime() < frame_utime) return PriorReason::kPoseTooOld;
  if (poses.oldest_utime() > frame_utime) return PriorReason::kPoseTooNew;
  return PriorReason::kPoseGap;
}

}  // namespace

std::vector<std::string> PriorConfig::validate() const {
  std::vector<std::string> errors;
  if (kind != "odometry" && kind != "localisation") {
    errors.push_back("kind must be odometry or localisation, not '" + kind + "'");
  }
  if (!(max_gap > 0.0) || !(max_gap <= 10.0)) {
    errors.push_back("max_gap must be above 0 and at most 10 s");
  }
  if (!(jump_distance > 0.0)) errors.push_back("jump_distance must be above 0 m");
  if (!(jump_angle_deg > 0.0)) errors.push_back("jump_angle_deg must be above 0");
  if (camera_position.size() != 3 || !all_finite(camera_position)) {
    errors.push_back("camera_position must be three numbers x, y, z [m]");
  }
  if (camera_quaternion.size() != 4 || !all_finite(camera_quaternion) ||
      std::abs(camera_quaternion_of(*this).norm() - 1.0) > 1e-3) {
    errors.push_back("camera_quaternion must be four numbers w, x, y, z of length 1");
  }
  return errors;
}

std::string_view to_string(PriorReason reason) {
  switch (reason) {
    case PriorReason::kInterpolated:
      return "interpolated";
    case PriorReason::kExtrapolated:
      return "extrapolated";
    case PriorReason::kHeld:
      return "held";
    case PriorReason::kNoPose:
      return "no_pose";
    case PriorReason::kPoseTooOld:
      return "pose_too_old";
    case PriorReason::kPoseTooNew:
      return "pose_too_new";
    case PriorReason::kPoseGap:
      return "pose_gap";
  }
  throw std::invalid_argument("no such prior reason");
}

PosePrior::PosePrior(const PriorConfig& config)
    : config_(validated(config)),
      T_body_camera_fixed_(fixed_T_body_camera(config_)),
      poses_(limits_of(config_)),
      necks_(limits_of(config_)) {}

void PosePrior::add_pose(std::int64_t utime, const Eigen::Isometry3d& T_odom_body) {
  advance_clock(utime, poses_.add(utime, T_odom_body));
}

void PosePrior::add_camera_to_body(std::int64_t utime, const Eigen::Isometry3d& T_body_camera) {
  advance_clock(utime, necks_.add(utime, T_body_camera));
}

void PosePrior::note_input(std::int64_t utime) {
  require_valid(utime);
  const bool restarted = last_input_ && utime < *last_input_ - kRestartAfter;
  last_input_ = restarted || !last_input_ ? utime : std::max(utime, *last_input_);
  advance_clock(utime, restarted);
}

void PosePrior::advance_clock(std::int64_t utime, bool restarted) {
  if (!is_valid_utime(utime)) return;
  clock_ = restarted || !clock_ ? utime : std::max(utime, *clock_);
}

bool PosePrior::is_ready(std::int64_t frame_utime) const {
  require_valid(frame_utime);
  if (!poses_.empty() && poses_.newest_utime() >= frame_utime) return true;
  if (!clock_) return false;
  return *clock_ >= frame_utime + max_gap_us(config_) || *clock_ < frame_utime - kRestartAfter;
}

Eigen::Isometry3d PosePrior::T_body_camera_at(std::int64_t utime) const {
  const auto near = necks_.at(utime);
  if (near && near->source == PoseBuffer::Source::kInterpolated) return near->T;
  if (const auto last = necks_.latest_until(utime)) return *last;
  const bool first_is_near =
      !necks_.empty() && necks_.oldest_utime() - utime <= max_gap_us(config_);
  return first_is_near ? *necks_.latest_until(necks_.oldest_utime()) : T_body_camera_fixed_;
}

Prior PosePrior::prior_at(std::int64_t frame_utime) const {
  require_valid(frame_utime);
  const auto body = poses_.at(frame_utime);
  if (!body) return {why_none(poses_, frame_utime), std::nullopt, std::nullopt};
  const Eigen::Isometry3d T_odom_camera = body->T * T_body_camera_at(frame_utime);
  const bool absolute = config_.kind == "localisation";
  return {reason_of(body->source), absolute ? T_odom_camera : T_world_odom_ * T_odom_camera,
          T_odom_camera};
}

void PosePrior::set_T_world_odom(const Eigen::Isometry3d& T_world_odom) {
  if (!is_rigid(T_world_odom)) throw std::invalid_argument("T_world_odom must be rigid");
  T_world_odom_ = T_world_odom;
}

}  // namespace geomap::perception
