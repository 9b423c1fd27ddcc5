// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <functional>

#include "mapping/geometric_map.hpp"
#include "perception/organized_extractor.hpp"
#include "perception/tracker.hpp"

namespace geomap::bench {

inline constexpr std::array kStages = {"tracking", "extraction, outlines", "merging"};

/// @brief A map that grows as the pipeline makes it grow, with a meter around each stage.
class StagedMapping {
 public:
  /// @brief Must run `work`, which is all of a key frame's stage (index into kStages).
  using Meter = std::function<void(std::size_t stage, const std::function<void()>& work)>;

  /// @param T_world_camera the frame's odometry.
  /// @return whether the frame became a key frame; if not, at most its tracking was metered.
  bool add(const geometry::RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera,
           const Meter& meter);

 private:
  perception::Tracker tracker_;
  perception::OrganizedExtractor extractor_;
  mapping::GeometricMap map_{mapping::MergeConfig{}, mapping::HistoryConfig{}};
};

}  // namespace geomap::bench
