// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "perception/frustum_icp.hpp"
#include "perception/registration.hpp"

namespace geomap::perception {

struct IcpRegistrationConfig {
  FrustumIcpConfig icp;
  int min_surfaces = 200;            // pixels of a thin frame with a surface
  double min_overlap = 0.25;         // share of the view's area that the map knows
  double min_agreement = 0.6;        // of surfels that are not seen through
  double max_rms = 0.02;             // [m]
  double max_correction = 0.4;       // of the prior's position [m]
  double max_correction_deg = 25.0;  // and of its direction
  double hold_sigma = 0.02;          // by which a measured prior may be off [m], see align()
  double margin = 0.1;               // around the frustum, for what the prior may be off [m]

  std::vector<std::string> validate() const;

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& visitor) {
    FrustumIcpConfig::visit(self.icp, visitor);
    visitor("min_surfaces", self.min_surfaces);
    visitor("min_overlap", self.min_overlap);
    visitor("min_agreement", self.min_agreement);
    visitor("max_rms", self.max_rms);
    visitor("max_correction", self.max_correction);
    visitor("max_correction_deg", self.max_correction_deg);
    visitor("hold_sigma", self.hold_sigma);
    visitor("margin", self.margin);
  }
};

/// @brief The paper's registration: what of the map lies in the camera's frustum, frustum ICP, and
/// acceptance by rms, overlap, agreement and conditioning together.
class IcpRegistration : public Registration {
 public:
  /// @throws std::invalid_argument when the configuration is not valid.
  explicit IcpRegistration(const IcpRegistrationConfig& config = {});

  /// An empty map accepts any view with enough surfaces at its prior.
  RegistrationResult align(const FrameView& view, const VoxelMap& map,
                           const Eigen::Isometry3d& T_world_camera_prior,
                           PriorSource source) const override;

 private:
  RegistrationReason judge(const RegistrationResult& result, PriorSource source) const;

  IcpRegistrationConfig config_;
};

}  // namespace geomap::perception
