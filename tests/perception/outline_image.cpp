// SPDX-License-Identifier: BSD-3-Clause
#include "perception/outline_image.hpp"

#include <algorithm>

namespace geomap::testing {

std::vector<bool> outline_image(const geometry::PlanarPolygon& surface,
                                const geometry::CameraModel& camera) {
  std::vector<bool> inside;
  inside.reserve(static_cast<std::size_t>(camera.width * camera.height));
  const auto box = geometry::bounding_box(surface.polygon);
  const Eigen::Isometry3d T_plane_camera = surface.frame.T_plane_parent();
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d ray = camera.ray(u, v);
      const double slope = surface.plane.normal.dot(ray);
      const Eigen::Vector3d point = -surface.plane.d / slope * ray;
      const Eigen::Vector2d at = (T_plane_camera * point).head<2>();
      inside.push_back(slope < 0.0 && box.contains(at) && geometry::contains(surface.polygon, at));
    }
  }
  return inside;
}

std::size_t common_pixels(const std::vector<bool>& a, const std::vector<bool>& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += a[i] && b[i] ? 1 : 0;
  return count;
}

std::size_t count_pixels(const std::vector<bool>& image) {
  return static_cast<std::size_t>(std::count(image.begin(), image.end(), true));
}

double overlap_ratio(const std::vector<bool>& a, const std::vector<bool>& b) {
  const std::size_t both = common_pixels(a, b);
  const std::size_t either = count_pixels(a) + count_pixels(b) - both;
  return either == 0 ? 0.0 : static_cast<double>(both) / static_cast<double>(either);
}

}  // namespace geomap::testing
