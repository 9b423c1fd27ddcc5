// SPDX-License-Identifier: BSD-3-Clause
#include "perception/trust_prior.hpp"

#include <stdexcept>

#include "perception/rigid_transform.hpp"

namespace geomap::perception {

std::vector<std::string> TrustPriorConfig::validate() const {
  if (min_readings < 1) return {"min_readings must be at least 1"};
  return {};
}

TrustPrior::TrustPrior(const TrustPriorConfig& config) : config_(config) {
  const auto errors = config.validate();
  if (!errors.empty()) throw std::invalid_argument("trust_prior: " + errors.front());
}

RegistrationResult TrustPrior::align(const FrameView& view, const VoxelMap&,
                                     const Eigen::Isometry3d& T_world_camera_prior,
                                     PriorSource source) const {
  RegistrationResult result;
  result.T_world_camera_prior = T_world_camera_prior;
  result.T_world_camera = T_world_camera_prior;
  result.readings = count_readings(view.thin.depth);
  if (!is_rigid(T_world_camera_prior)) {
    result.reason = RegistrationReason::kInvalidPrior;
  } else if (result.readings < config_.min_readings) {
    result.reason = RegistrationReason::kTooFewReadings;
  } else if (source == PriorSource::kGuessed) {
    result.reason = RegistrationReason::kUnderconstrained;
  } else {
    result.reason = RegistrationReason::kPriorTrusted;
    result.accepted = true;
  }
  return result;
}

}  // namespace geomap::perception
