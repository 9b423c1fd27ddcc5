// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/plane.hpp"
#include "geometry/rgbd_frame.hpp"
#include "perception/depth_cells.hpp"
#include "perception/depth_tolerance.hpp"

namespace geomap::perception {

/// @brief Settings that every plane extractor has.
struct ExtractionConfig {
  double min_depth = 0.3;  // nearer readings are ignored [m]
  double max_depth = 6.0;  // farther readings are ignored [m]

  std::string noise = "auto";       // auto: factor estimated per frame; fixed: noise_factor
  double noise_factor = 1.0;        // of the sensor model, where fixed
  double noise_gate = 3.0;          // how many sigma a reading may be off its plane
  double systematic_error = 0.006;  // of a real camera, as a share of the depth

  double max_normal_angle_deg = 25.0;  // between a point's normal and its plane's
  double max_merge_angle_deg = 8.0;    // between pieces of one surface
  double part_gap = 0.03;  // between inliers of one plane; beyond, they are two planes [m]

  double simplify_tolerance = 0.01;  // of the outline, one pixel's length is added [m]

  double min_area = 0.015;     // of a plane [m²]
  int min_pixels = 200;        // of a plane
  double min_fill = 0.4;       // share of the outline's area that pixels cover
  double max_rms_ratio = 1.6;  // rms of a plane over what the noise model expects
  double max_curvature = 3.0;  // of a plane [1/m]; beyond, it is a cylinder or a ball

  std::string orientation = "any";  // any, horizontal, vertical: which planes are wanted (paper)
  double max_tilt_deg = 10.0;       // from exactly horizontal or vertical

  std::vector<std::string> validate() const;

  /// @brief How far readings of a frame may be off, its noise estimated where configured.
  DepthTolerance tolerance_of(const DepthCells& cells) const;
  /// @brief Of the wanted orientation. @param up_camera needed unless any is wanted.
  bool wants(const geometry::Plane& plane, const std::optional<Eigen::Vector3d>& up_camera) const;
  /// @throws std::invalid_argument when the depth image's size is not that of its camera or its
  /// buffer, the camera is invalid, or an orientation is wanted and `up_camera` is missing or zero.
  void require_valid(const geometry::RgbdFrame& frame,
                     const std::optional<Eigen::Vector3d>& up_camera) const;

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& visitor) {
    visitor("min_depth", self.min_depth);
    visitor("max_depth", self.max_depth);
    visitor("noise", self.noise);
    visitor("noise_factor", self.noise_factor);
    visitor("noise_gate", self.noise_gate);
    visitor("systematic_error", self.systematic_error);
    visitor("max_normal_angle_deg", self.max_normal_angle_deg);
    visitor("max_merge_angle_deg", self.max_merge_angle_deg);
    visitor("part_gap", self.part_gap);
    visitor("simplify_tolerance", self.simplify_tolerance);
    visitor("min_area", self.min_area);
    visitor("min_pixels", self.min_pixels);
    visitor("min_fill", self.min_fill);
    visitor("max_rms_ratio", self.max_rms_ratio);
    visitor("max_curvature", self.max_curvature);
    visitor("orientation", self.orientation);
    visitor("max_tilt_deg", self.max_tilt_deg);
  }
};

/// @brief Collects what is wrong with settings.
class ConfigChecks {
 public:
  void between(const char* name, double value, double least, double largest);
  void one_of(const char* name, const std::string& value,
              std::initializer_list<const char*> choices);
  std::vector<std::string> messages;
};

/// @throws std::invalid_argument with all messages, if there are any.
void require_no_faults(const char* what, const std::vector<std::string>& messages);

}  // namespace geomap::perception
