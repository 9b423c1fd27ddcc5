// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "perception/registration.hpp"

namespace geomap::perception {

struct TrustPriorConfig {
  int min_readings = 20;  // pixels of a thin frame with depth; fewer: the frame is blind

  std::vector<std::string> validate() const;
};

/// @brief Registration for robots and data sets whose poses are good already: takes every finite
/// rigid measured prior as the pose, and measures neither rms nor overlap.
class TrustPrior : public Registration {
 public:
  /// @throws std::invalid_argument when the configuration is not valid.
  explicit TrustPrior(const TrustPriorConfig& config = {});

  RegistrationResult align(const FrameView& view, const VoxelMap& map,
                           const Eigen::Isometry3d& T_world_camera_prior,
                           PriorSource source) const override;

 private:
  TrustPriorConfig config_;
};

}  // namespace geomap::perception
