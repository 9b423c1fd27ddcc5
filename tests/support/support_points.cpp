// SPDX-License-Identifier: BSD-3-Clause
#include "support/support_points.hpp"

#include <cmath>

namespace geomap::testing {
namespace {

constexpr double kCube = 0.01;  // [m]

}  // namespace

SupportPoints::Cube SupportPoints::cube_of(const Eigen::Vector3d& p) {
  return {static_cast<std::int64_t>(std::floor(p.x() / kCube)),
          static_cast<std::int64_t>(std::floor(p.y() / kCube)),
          static_cast<std::int64_t>(std::floor(p.z() / kCube))};
}

void SupportPoints::add(const geometry::RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera) {
  for (int v = 0; v < frame.depth.height; ++v) {
    for (int u = 0; u < frame.depth.width; ++u) {
      const std::uint16_t reading = frame.depth.at(u, v);
      if (!geometry::DepthImage::is_reading(reading)) continue;
      const Eigen::Vector3d p = T_world_camera * frame.depth_camera.point(u, v, 1e-3 * reading);
      points_.try_emplace(cube_of(p), p);
    }
  }
}

bool SupportPoints::near(const Eigen::Vector3d& p, double radius) const {
  const Cube center = cube_of(p);
  const auto reach = static_cast<std::int64_t>(std::ceil(radius / kCube));
  for (std::int64_t x = -reach; x <= reach; ++x) {
    for (std::int64_t y = -reach; y <= reach; ++y) {
      for (std::int64_t z = -reach; z <= reach; ++z) {
        const auto found = points_.find({center[0] + x, center[1] + y, center[2] + z});
        if (found != points_.end() && (found->second - p).norm() <= radius) return true;
      }
    }
  }
  return false;
}

double SupportPoints::supported_share(const std::vector<mapping::MapFeature>& features,
                                      double radius) const {
  constexpr double kStep = 0.02;  // [m]
  std::int64_t samples = 0;
  std::int64_t supported = 0;
  for (const mapping::MapFeature& feature : features) {
    const Eigen::AlignedBox2d box = geometry::bounding_box(feature.surface.polygon);
    for (double x = box.min().x() + 0.5 * kStep; x < box.max().x(); x += kStep) {
      for (double y = box.min().y() + 0.5 * kStep; y < box.max().y(); y += kStep) {
        if (!geometry::contains(feature.surface.polygon, {x, y})) continue;
        ++samples;
        supported += near(feature.surface.lift(Eigen::Vector2d(x, y)), radius);
      }
    }
  }
  return samples > 0 ? static_cast<double>(supported) / static_cast<double>(samples) : 0.0;
}

}  // namespace geomap::testing
