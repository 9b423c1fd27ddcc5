// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string_view>

#include "geometry/rgbd_frame.hpp"

namespace geomap::perception {

/// @brief What became of an alignment: why it was accepted or rejected.
enum class RegistrationReason {
  kPriorTrusted,    // accepted: nothing was aligned, the prior was taken as it is
  kTooFewReadings,  // rejected: too little depth in the frame
  kInvalidPrior,    // rejected: the prior is not finite or not a rotation and a translation
};

/// @brief Stable name for reports and messages, for example "too_few_readings".
std::string_view to_string(RegistrationReason reason);

/// @brief Outcome of the registration of one frame.
struct RegistrationResult {
  bool accepted = false;
  RegistrationReason reason = RegistrationReason::kInvalidPrior;
  Eigen::Isometry3d T_world_camera_prior = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();  // the prior where rejected
  int readings = 0;  // pixels of the frame with a depth reading
  // Measured by an alignment, absent where none was made.
  std::optional<double> rms;      // distance of matched points [m]
  std::optional<double> overlap;  // share of the frame's points that found a partner, 0..1
};

/// @brief The stage that decides the pose of a key frame and whether the frame enters the map.
/// An alignment must not depend on anything but its arguments and the frames accepted before.
class Registration {
 public:
  virtual ~Registration() = default;

  virtual RegistrationResult align(const geometry::RgbdFrame& frame,
                                   const Eigen::Isometry3d& T_world_camera_prior) = 0;
};

}  // namespace geomap::perception
