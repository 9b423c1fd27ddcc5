// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string_view>

#include "perception/frustum_icp.hpp"
#include "perception/point_map.hpp"

namespace geomap::perception {

/// @brief What became of an alignment: why it was accepted or rejected.
enum class RegistrationReason {
  kAligned,           // accepted
  kFirst,             // accepted: there was no map yet, the prior fixes its frame
  kPriorTrusted,      // accepted: nothing was aligned, the prior was taken as it is
  kUnknownView,       // accepted: the map knows too little of the view, odometry tells the pose
  kTooFewReadings,    // rejected: too little depth, or too few surfaces, in the frame
  kInvalidPrior,      // rejected: the prior is not finite or not a rotation and a translation
  kOverlapTooSmall,   // rejected: too little of the view is in the map
  kSeenThrough,       // rejected: the view looks through too many of the map's surfaces
  kRmsTooLarge,       // rejected: partners lie too far from each other
  kNotConverged,      // rejected: the steps did not become small
  kTooFarFromPrior,   // rejected: moved farther than the prior can be wrong
  kUnderconstrained,  // rejected: directions are open, and no odometry tells them
};

/// @brief Stable name for reports and messages, for example "too_few_readings".
std::string_view to_string(RegistrationReason reason);

/// @brief Where the pose comes from that an alignment starts at.
enum class PriorSource {
  kMeasured,  // odometry or localisation: stands in for what the view leaves open
  kGuessed,   // constant velocity, or a place the camera was at before: only a start
};

/// @brief Outcome of the registration of one frame.
struct RegistrationResult {
  bool accepted = false;
  RegistrationReason reason = RegistrationReason::kInvalidPrior;
  Eigen::Isometry3d T_world_camera_prior = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();  // the prior where rejected
  int readings = 0;                    // pixels of the thin frame with a depth reading
  std::optional<Alignment> alignment;  // absent where none was made
  int blocks_visited = 0;              // of the map, to find what lies in the frustum
};

/// @brief The stage that decides the pose of a key frame and whether the frame enters the map.
/// An alignment must not depend on anything but its arguments.
class Registration {
 public:
  virtual ~Registration() = default;

  virtual RegistrationResult align(const FrameView& view, const VoxelMap& map,
                                   const Eigen::Isometry3d& T_world_camera_prior,
                                   PriorSource source) const = 0;
};

/// @brief Pixels with a depth reading.
int count_readings(const geometry::DepthImage& depth);

}  // namespace geomap::perception
