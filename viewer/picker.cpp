// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/picker.hpp"

#include <algorithm>
#include <cmath>

namespace geomap::viewer {
namespace {

constexpr double kParallel = 0.0087;  // sine of the angle between ray and plane: 0.5°
constexpr double kLineOn = 0.12;      // the same, below which a polygon is no more than a line
constexpr double kReachPixels = 5.0;

std::optional<double> distance_to_polygon(const Ray& ray, const geometry::PlanarPolygon& polygon) {
  const auto distance = distance_to_plane(ray, polygon.plane);
  if (!distance) return std::nullopt;
  const Eigen::Vector3d in_frame = polygon.frame.T_plane_parent() * ray.at(*distance);
  if (!geometry::contains(polygon.polygon, in_frame.head<2>())) return std::nullopt;
  return distance;
}

// Of the nearest edge that is within reach of the pixel.
std::optional<double> distance_to_outline(const ViewCamera& camera, const Ray& ray,
                                          const Eigen::Vector2d& pixel,
                                          const geometry::PlanarPolygon& polygon) {
  std::optional<double> nearest;
  for (const geometry::PolygonPart& part : polygon.polygon.parts) {
    for (std::size_t i = 0; i < part.outer.size(); ++i) {
      const Eigen::Vector3d a = polygon.lift(part.outer[i]);
      const Eigen::Vector3d b = polygon.lift(part.outer[(i + 1) % part.outer.size()]);
      const auto pixel_a = camera.project(a), pixel_b = camera.project(b);
      if (!pixel_a || !pixel_b) continue;
      if (distance_to_segment(pixel, *pixel_a, *pixel_b) > kReachPixels) continue;
      const double distance =
          std::min((a - ray.origin).dot(ray.direction), (b - ray.origin).dot(ray.direction));
      nearest = std::min(distance, nearest.value_or(distance));
    }
  }
  return nearest;
}

}  // namespace

std::optional<double> distance_to_plane(const Ray& ray, const geometry::Plane& plane) {
  const double slope = plane.normal.dot(ray.direction);
  if (std::abs(slope) < kParallel) return std::nullopt;
  const double distance = -(plane.normal.dot(ray.origin) + plane.d) / slope;
  if (!(distance > 0.0)) return std::nullopt;
  return distance;
}

std::optional<Hit> pick_feature(const SurfaceCache& cache, const ViewCamera& camera,
                                const Eigen::Vector2d& pixel) {
  const Ray ray = camera.ray(pixel);
  std::optional<Hit> nearest;
  for (const auto& [id, surface] : cache.surfaces()) {
    const geometry::PlanarPolygon& polygon = surface.polygon;
    const bool is_line = std::abs(polygon.plane.normal.dot(ray.direction)) < kLineOn;
    auto distance = distance_to_polygon(ray, polygon);
    if (!distance && is_line) distance = distance_to_outline(camera, ray, pixel, polygon);
    if (distance && (!nearest || *distance < nearest->distance)) {
      nearest = Hit{id, *distance, ray.at(*distance)};
    }
  }
  return nearest;
}

std::set<mapping::FeatureId> features_inside(const SurfaceCache& cache, const ViewCamera& camera,
                                             const Eigen::AlignedBox2d& rectangle) {
  std::set<mapping::FeatureId> inside;
  for (const auto& [id, surface] : cache.surfaces()) {
    const auto vertices = geometry::vertices(surface.polygon.polygon);
    const bool is_inside =
        std::all_of(vertices.begin(), vertices.end(), [&](geometry::GridPoint vertex) {
          const auto pixel = camera.project(surface.polygon.lift(vertex));
          return pixel && rectangle.contains(*pixel);
        });
    if (is_inside && !vertices.empty()) inside.insert(id);
  }
  return inside;
}

double distance_to_segment(const Eigen::Vector2d& point, const Eigen::Vector2d& a,
                           const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double squared = along.squaredNorm();
  const double share = squared > 0.0 ? std::clamp((point - a).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (point - (a + share * along)).norm();
}

}  // namespace geomap::viewer
