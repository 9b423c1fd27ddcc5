// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "perception/ransac_extractor.hpp"

namespace geomap::perception {
namespace {

class Checks {
 public:
  void between(const char* name, double value, double least, double largest) {
    if (value >= least && value <= largest) return;
    messages.push_back(std::string(name) + " = " + std::to_string(value) + " is not in [" +
                       std::to_string(least) + ", " + std::to_string(largest) + "]");
  }
  void one_of(const char* name, const std::string& value,
              std::initializer_list<const char*> choices) {
    std::string listed;
    for (const char* choice : choices) {
      if (value == choice) return;
      listed += (listed.empty() ? "" : ", ") + std::string(choice);
    }
    messages.push_back(std::string(name) + " = '" + value + "' is none of " + listed);
  }
  std::vector<std::string> messages;
};

}  // namespace

std::vector<std::string> RansacExtractorConfig::validate() const {
  Checks check;
  check.between("min_depth", min_depth, 0.01, 60.0);
  check.between("max_depth", max_depth, 0.02, 65.0);
  if (!(min_depth < max_depth)) check.messages.push_back("min_depth is not below max_depth");
  check.one_of("noise", noise, {"auto", "fixed"});
  check.between("noise_factor", noise_factor, 0.01, 100.0);
  check.between("noise_gate", noise_gate, 1.0, 10.0);
  check.between("systematic_error", systematic_error, 0.0, 0.1);
  check.between("voxel_size", voxel_size, 0.005, 0.5);
  check.between("cluster_tolerance", cluster_tolerance, 0.005, 1.0);
  check.between("min_cluster_voxels", min_cluster_voxels, 3, 1e6);
  check.between("ransac_iterations", ransac_iterations, 1, 1e6);
  check.between("max_normal_angle_deg", max_normal_angle_deg, 1.0, 60.0);
  check.between("max_merge_angle_deg", max_merge_angle_deg, 0.0, 45.0);
  check.between("part_gap", part_gap, 0.0, 1.0);
  check.between("alpha", alpha, 0.01, 1.0);
  check.between("simplify_tolerance", simplify_tolerance, 0.0, 0.5);
  check.between("min_area", min_area, 0.0, 100.0);
  check.between("min_pixels", min_pixels, 10, 1e7);
  check.between("min_fill", min_fill, 0.0, 1.0);
  check.between("max_rms_ratio", max_rms_ratio, 1.0, 100.0);
  check.between("max_curvature", max_curvature, 0.0, 1000.0);
  check.one_of("orientation", orientation, {"any", "horizontal", "vertical"});
  check.between("max_tilt_deg", max_tilt_deg, 0.1, 45.0);
  return check.messages;
}

}  // namespace geomap::perception
