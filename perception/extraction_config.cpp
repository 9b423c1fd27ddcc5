// SPDX-License-Identifier: BSD-3-Clause
#include "perception/extraction_config.hpp"

#include <cmath>
#include <stdexcept>

#include "geometry/angles.hpp"
#include "perception/noise_estimate.hpp"

namespace geomap::perception {

void ConfigChecks::between(const char* name, double value, double least, double largest) {
  if (value >= least && value <= largest) return;
  messages.push_back(std::string(name) + " = " + std::to_string(value) + " is not in [" +
                     std::to_string(least) + ", " + std::to_string(largest) + "]");
}

void ConfigChecks::one_of(const char* name, const std::string& value,
                          std::initializer_list<const char*> choices) {
  std::string listed;
  for (const char* choice : choices) {
    if (value == choice) return;
    listed += (listed.empty() ? "" : ", ") + std::string(choice);
  }
  messages.push_back(std::string(name) + " = '" + value + "' is none of " + listed);
}

void require_no_faults(const char* what, const std::vector<std::string>& messages) {
  std::string all;
  for (const std::string& message : messages) all += (all.empty() ? "" : "; ") + message;
  if (!all.empty()) throw std::invalid_argument(std::string(what) + ": " + all);
}

std::vector<std::string> ExtractionConfig::validate() const {
  ConfigChecks check;
  check.between("min_depth", min_depth, 0.01, 60.0);
  check.between("max_depth", max_depth, 0.02, 65.0);
  if (!(min_depth < max_depth)) check.messages.push_back("min_depth is not below max_depth");
  check.one_of("noise", noise, {"auto", "fixed"});
  check.between("noise_factor", noise_factor, 0.01, 100.0);
  check.between("noise_gate", noise_gate, 1.0, 10.0);
  check.between("systematic_error", systematic_error, 0.0, 0.1);
  check.between("max_normal_angle_deg", max_normal_angle_deg, 1.0, 60.0);
  check.between("max_merge_angle_deg", max_merge_angle_deg, 0.0, 45.0);
  check.between("part_gap", part_gap, 0.0, 1.0);
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

DepthTolerance ExtractionConfig::tolerance_of(const DepthCells& cells) const {
  geometry::DepthNoise model;
  model.factor = noise_factor;
  DepthTolerance tolerance;
  tolerance.noise = noise == "auto" ? estimate_noise(cells, model) : model;
  tolerance.gate = noise_gate;
  tolerance.systematic = systematic_error;
  return tolerance;
}

bool ExtractionConfig::wants(const geometry::Plane& plane,
                             const std::optional<Eigen::Vector3d>& up_camera) const {
  if (orientation == "any") return true;
  const double rise = std::abs(plane.normal.dot(up_camera->normalized()));
  const double tilt = geometry::radians(max_tilt_deg);
  return orientation == "horizontal" ? rise >= std::cos(tilt) : rise <= std::sin(tilt);
}

void ExtractionConfig::require_valid(const geometry::RgbdFrame& frame,
                                     const std::optional<Eigen::Vector3d>& up_camera) const {
  if (orientation != "any" && !(up_camera && up_camera->norm() > 0.0)) {
    throw std::invalid_argument("plane extraction: an orientation is wanted, but not where up is");
  }
  const geometry::DepthImage& depth = frame.depth;
  if (depth.empty()) return;
  const auto pixels =
      static_cast<std::size_t>(depth.width) * static_cast<std::size_t>(depth.height);
  if (depth.width <= 0 || depth.height <= 0 || depth.millimetres.size() != pixels) {
    throw std::invalid_argument("plane extraction: the depth image's buffer has not its size");
  }
  if (!frame.depth_camera.valid() || frame.depth_camera.width != depth.width ||
      frame.depth_camera.height != depth.height) {
    throw std::invalid_argument("plane extraction: the depth camera is not that of the image");
  }
}

}  // namespace geomap::perception
