// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace geomap::mapping {

/// @brief Settings of merging. Lengths in metres.
struct MergeConfig {
  std::string mode = "moments";  // "moments", or "paper": equations 4-12 as printed

  // mode moments
  double sigma_pose = 0.005;        // systematic error of one view's offset: caps its weight [m]
  double systematic_share = 1.0;    // of the sensor's sigma_z that averaging a view does not remove
  double full_weight_area = 1.0;    // views of less surface weigh in proportion to it [m²]
  double min_angle_deg = 3.0;       // planes this close in angle may always merge
  double max_angle_deg = 15.0;      // never merge beyond, however uncertain
  double min_distance = 0.01;       // bounds of the distance gate, rms over the overlap [m]
  double max_distance = 0.08;       // [m]
  double gap = 0.03;                // parts closer than this count as touching [m]
  double min_overlap_area = 0.002;  // least overlap [m²]
  double min_overlap_share = 0.05;  // least overlap as a share of the smaller feature, unless they
                                    // share a border half as long as the smaller one's side
  double min_view_cosine = 0.1;     // |n·ray| below which a view decides no side and is not fused
  double outline_error = 0.01;      // by which a new view must exceed the outline to extend it [m]
  double rebase_angle_deg = 0.5;    // turn of the plane against its frame that moves the frame

  // mode paper
  double paper_cosine = 0.95;   // t1 of equation 6a
  double paper_distance = 0.1;  // t2 of equation 6b [m]

  std::vector<std::string> validate() const;

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& visitor) {
    visitor("mode", self.mode);
    visitor("sigma_pose", self.sigma_pose);
    visitor("systematic_share", self.systematic_share);
    visitor("full_weight_area", self.full_weight_area);
    visitor("min_angle_deg", self.min_angle_deg);
    visitor("max_angle_deg", self.max_angle_deg);
    visitor("min_distance", self.min_distance);
    visitor("max_distance", self.max_distance);
    visitor("gap", self.gap);
    visitor("min_overlap_area", self.min_overlap_area);
    visitor("min_overlap_share", self.min_overlap_share);
    visitor("min_view_cosine", self.min_view_cosine);
    visitor("outline_error", self.outline_error);
    visitor("rebase_angle_deg", self.rebase_angle_deg);
    visitor("paper_cosine", self.paper_cosine);
    visitor("paper_distance", self.paper_distance);
  }
};

}  // namespace geomap::mapping
