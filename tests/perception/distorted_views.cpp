// SPDX-License-Identifier: BSD-3-Clause
#include "distorted_views.hpp"

#include <cmath>

namespace geomap::perception {

geometry::DepthCorrection bowl() {
  geometry::DepthCorrection::Terms coefficients = geometry::DepthCorrection::Terms::Zero();
  coefficients(2) = 0.004;   // x²
  coefficients(4) = -0.003;  // y²
  coefficients(6) = 0.002;   // x² y
  return geometry::DepthCorrection(coefficients);
}

geometry::RgbdFrame distorted(const testing::Rendering& rendering,
                              const geometry::DepthCorrection& correction) {
  geometry::RgbdFrame frame = rendering.frame;
  for (int v = 0; v < frame.depth.height; ++v) {
    for (int u = 0; u < frame.depth.width; ++u) {
      const auto i = static_cast<std::size_t>(v * frame.depth.width + u);
      if (rendering.depth[i] == 0.0) continue;
      const Eigen::Vector3d ray = frame.depth_camera.ray(u, v);
      const double z = rendering.depth[i] / (1.0 + correction.share(ray.x(), ray.y()));
      frame.depth.millimetres[i] = static_cast<std::uint16_t>(std::lround(1e3 * z));
    }
  }
  return frame;
}

std::vector<Eigen::Isometry3d> poses_around_the_room() {
  std::vector<Eigen::Isometry3d> result;
  for (int i = 0; i < 40; ++i) {
    const double turn = 0.5 * i;
    result.push_back(testing::look_at(
        {0.7 + 0.4 * std::cos(turn), -0.9 + 0.4 * std::sin(turn), 1.3 + 0.15 * std::cos(2 * turn)},
        {-0.9 + 0.7 * std::sin(1.7 * turn), 1.1 - 0.7 * std::cos(1.3 * turn),
         0.7 + 0.4 * std::sin(turn)},
        {0.3 * std::sin(2.3 * turn), 0.3 * std::cos(1.9 * turn), 1.0}));
  }
  return result;
}

}  // namespace geomap::perception
