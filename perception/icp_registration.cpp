// SPDX-License-Identifier: BSD-3-Clause
#include "perception/icp_registration.hpp"

#include <stdexcept>
#include <utility>

#include "geometry/angles.hpp"
#include "geometry/frustum.hpp"
#include "perception/rigid_transform.hpp"

namespace geomap::perception {
namespace {

constexpr double kGuessShare = 0.25;  // of the noise factor, for a prior that is only a guess

bool is_share(double value) { return value >= 0.0 && value <= 1.0; }

// What the camera sees up to its farthest surface, grown by what the prior may be off: moved back
// for the sides, prolonged at the far end.
geometry::Frustum frustum_of(const FrameView& view, const Eigen::Isometry3d& T_world_camera,
                             double margin) {
  constexpr double kNear = 0.1;  // [m]
  const Eigen::Isometry3d behind = T_world_camera * Eigen::Translation3d(0.0, 0.0, -2.0 * margin);
  return {view.thin.depth_camera, kNear, view.surfaces.farthest() + 3.0 * margin, behind};
}

}  // namespace

std::vector<std::string> IcpRegistrationConfig::validate() const {
  std::vector<std::string> errors = icp.validate();
  if (min_surfaces < 30) errors.push_back("min_surfaces must be at least 30");
  if (!is_share(min_overlap)) errors.push_back("min_overlap must be between 0 and 1");
  if (!is_share(min_agreement)) errors.push_back("min_agreement must be between 0 and 1");
  if (!(max_rms > 0.0)) errors.push_back("max_rms must be above 0 m");
  if (!(max_correction > 0.0)) errors.push_back("max_correction must be above 0 m");
  if (!(max_correction_deg > 0.0)) errors.push_back("max_correction_deg must be above 0");
  if (!(hold_sigma >= 0.0)) errors.push_back("hold_sigma must be 0 m or more");
  if (!(margin >= 0.0) || !(margin <= 10.0)) errors.push_back("margin must be 0 to 10 m");
  return errors;
}

IcpRegistration::IcpRegistration(const IcpRegistrationConfig& config) : config_(config) {
  const auto errors = config.validate();
  if (!errors.empty()) throw std::invalid_argument("registration: " + errors.front());
}

RegistrationResult IcpRegistration::align(const FrameView& view, const VoxelMap& map,
                                          const Eigen::Isometry3d& T_world_camera_prior,
                                          PriorSource source) const {
  RegistrationResult result;
  result.T_world_camera_prior = result.T_world_camera = T_world_camera_prior;
  result.readings = count_readings(view.thin.depth);
  if (!is_rigid(T_world_camera_prior)) return result;
  if (view.surfaces.size() < config_.min_surfaces) {
    result.reason = RegistrationReason::kTooFewReadings;
    return result;
  }
  if (map.size() == 0) {
    result.reason = RegistrationReason::kFirst;
    result.accepted = true;
    return result;
  }
  const SurfelSelection selection =
      map.surfels_in(frustum_of(view, T_world_camera_prior, config_.margin));
  result.blocks_visited = selection.blocks_visited;
  // Where the prior is a guess, what the view tells weakly is still the better of the two.
  FrustumIcpConfig icp = config_.icp;
  if (source == PriorSource::kGuessed) icp.noise_factor *= kGuessShare;
  result.alignment = perception::align(selection.surfels, view.surfaces, T_world_camera_prior, icp,
                                       source == PriorSource::kMeasured ? config_.hold_sigma : 0.0);
  result.reason = judge(result, source);
  result.accepted = result.reason == RegistrationReason::kAligned;
  if (result.accepted) result.T_world_camera = result.alignment->T_world_camera;
  return result;
}

RegistrationReason IcpRegistration::judge(const RegistrationResult& result,
                                          PriorSource source) const {
  const Alignment& found = *result.alignment;
  const Eigen::Isometry3d& prior = result.T_world_camera_prior;
  const double moved = (found.T_world_camera.translation() - prior.translation()).norm();
  const double turned_deg = geometry::degrees(angle_between(prior, found.T_world_camera));
  if (found.overlap < config_.min_overlap) return RegistrationReason::kOverlapTooSmall;
  if (found.agreement < config_.min_agreement) return RegistrationReason::kSeenThrough;
  if (found.rms > config_.max_rms) return RegistrationReason::kRmsTooLarge;
  if (!found.converged) return RegistrationReason::kNotConverged;
  if (moved > config_.max_correction || turned_deg > config_.max_correction_deg) {
    return RegistrationReason::kTooFarFromPrior;
  }
  if (source == PriorSource::kGuessed && found.observed_directions < 6) {
    return RegistrationReason::kUnderconstrained;
  }
  return RegistrationReason::kAligned;
}

}  // namespace geomap::perception
