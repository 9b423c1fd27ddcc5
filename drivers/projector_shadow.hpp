// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace geomap::drivers {

/// @brief Finds the pixels of an image row whose surface a pattern projector cannot light because a
/// nearer surface of the same row is in between. The projector stands beside the camera, on its x
/// axis, and looks the same way.
class ProjectorShadow {
 public:
  /// @param focal_times_baseline The camera's fx [pixel] times the projector's x [m].
  ProjectorShadow(int width, double focal_times_baseline);

  /// @brief Sets `shadowed` to 1 where no light arrives and to 0 elsewhere.
  /// @param depth One row of depths [m], `width` long; 0 or less where there is no surface.
  void find(std::span<const double> depth, std::span<std::uint8_t> shadowed);

 private:
  int width_;
  double focal_times_baseline_;
  std::vector<double> shift_;    // per pixel: its column minus the projector's [pixel]
  std::vector<int> column_;      // per pixel: column of the projector, 0 means -width
  std::vector<double> nearest_;  // per column of the projector: the largest shift seen there
};

}  // namespace geomap::drivers
