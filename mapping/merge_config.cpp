// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/merge_config.hpp"

namespace geomap::mapping {

std::vector<std::string> MergeConfig::validate() const {
  std::vector<std::string> messages;
  const auto require = [&](bool holds, const char* message) {
    if (!holds) messages.emplace_back(message);
  };
  require(mode == "moments" || mode == "paper", "mode must be 'moments' or 'paper'");
  require(sigma_pose > 0.0, "sigma_pose must be positive");
  require(systematic_share >= 0.0, "systematic_share must not be negative");
  require(full_weight_area > 0.0, "full_weight_area must be positive");
  require(min_angle_deg > 0.0 && max_angle_deg >= min_angle_deg && max_angle_deg < 90.0,
          "angles must satisfy 0 < min_angle_deg <= max_angle_deg < 90");
  require(min_distance > 0.0 && max_distance >= min_distance,
          "distances must satisfy 0 < min_distance <= max_distance");
  require(gap >= 0.0, "gap must not be negative");
  require(min_overlap_area > 0.0, "min_overlap_area must be positive");
  require(min_overlap_share >= 0.0 && min_overlap_share <= 1.0,
          "min_overlap_share must be between 0 and 1");
  require(min_view_cosine >= 0.0 && min_view_cosine < 1.0,
          "min_view_cosine must be at least 0 and below 1");
  require(outline_error > 0.0, "outline_error must be positive");
  require(rebase_angle_deg > 0.0, "rebase_angle_deg must be positive");
  require(paper_cosine > 0.0 && paper_cosine < 1.0, "paper_cosine must be between 0 and 1");
  require(paper_distance > 0.0, "paper_distance must be positive");
  return messages;
}

}  // namespace geomap::mapping
