// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "perception/surface_image.hpp"
#include "perception/surfel.hpp"

namespace geomap::perception {

struct FrustumIcpConfig {
  int max_iterations = 30;
  int coarse_iterations = 3;           // with every fourth surfel and a wide gate
  double coarse_gate = 0.15;           // distance up to which partners are believed at first [m]
  double gate = 0.05;                  // and in the end [m]; halves from step to step in between
  double max_normal_angle_deg = 40.0;  // between the normals of partners
  double prior_sigma = 0.05;           // what is known of the pose beforehand [m], see align()
  double least_information = 0.0007;   // of a direction, against one that every surfel fixes

  double noise_factor = 2.0;  // and against what noise of the normals feigns

  std::vector<std::string> validate() const;

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& visitor) {
    visitor("max_iterations", self.max_iterations);
    visitor("coarse_iterations", self.coarse_iterations);
    visitor("coarse_gate", self.coarse_gate);
    visitor("gate", self.gate);
    visitor("max_normal_angle_deg", self.max_normal_angle_deg);
    visitor("prior_sigma", self.prior_sigma);
    visitor("least_information", self.least_information);
    visitor("noise_factor", self.noise_factor);
  }
};

/// @brief What an alignment found, and how far it can be believed.
struct Alignment {
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  bool converged = false;  // the last step was below 1 mm and 0.06 degrees
  int partners = 0;        // surfels that took part in the last step
  int iterations = 0;
  double rms = 0.0;             // weighted, of the partners' distances along the normals [m]
  double overlap = 0.0;         // share of the view's area that lies on known surface, 0..1
  double agreement = 0.0;       // partners against partners and surfels seen through, 0..1
  int observed_directions = 0;  // of the six of a motion
  double conditioning = 0.0;    // smallest information of a direction over the largest, 0..1
};

/// @brief Frustum ICP (paper, section on registration): aligns a view to the surfels inside the
/// camera's frustum, point to plane.
///
/// Each surfel is moved into the camera and falls onto a pixel of the view, whose surface is its
/// partner; the residual lies along the surfel's normal, between the surfel and where its viewing
/// ray meets the partner's plane. Corrections compose on the left and are linearised about the
/// camera's centre: T_world_camera = dT_world · T_world_camera.
///
/// Rotations are scaled by the partners' rms distance from the camera, so that all six directions
/// are lengths. The eigenvectors of the information matrix whose information exceeds the prior's
/// (1/prior_sigma²), least_information of the whole weight, and noise_factor times what the
/// disagreement of the partners' normals alone would feign, count as observed. They are judged once
/// coarse steps in all directions have aligned the view; from then on the correction of the prior
/// is projected onto them, and the rest of the pose stays the prior's: what a wall, a floor or a
/// corridor does not tell is not made up.
///
/// @param surfels of the map, any order that depends on the map alone; those outside the view cost
/// little and change nothing.
/// @param hold_sigma by which the prior may be off, if it was measured [m]: it is then one more
/// measurement, which decides where the view tells little, and counts less the farther the view is
/// from it. 0: only a start.
/// @throws std::invalid_argument unless the prior is rigid.
Alignment align(const std::vector<Surfel>& surfels, const SurfaceImage& view,
                const Eigen::Isometry3d& T_world_camera_prior, const FrustumIcpConfig& config = {},
                double hold_sigma = 0.0);

}  // namespace geomap::perception
