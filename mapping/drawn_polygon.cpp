// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/drawn_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/polygon_clip.hpp"
#include "mapping/fuse.hpp"

namespace geomap::mapping {
namespace {

constexpr double kOffPlane = 0.05;         // of a corner [m]
constexpr double kFarthestDrawn = 1000.0;  // from the polygon's centre [m]

// Newell: the normal that the sum of the corners' cross products gives.
Eigen::Vector3d area_vector(std::span<const Eigen::Vector3d> corners,
                            const Eigen::Vector3d& center) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d& next = corners[(i + 1) % corners.size()];
    sum += (corners[i] - center).cross(next - center);
  }
  return 0.5 * sum;
}

geometry::PlaneMoments even_moments(const geometry::Polygon& polygon, double weight) {
  const geometry::AreaMoments area = geometry::area_moments(polygon);
  geometry::PlaneMoments moments;
  moments.weight = weight;
  moments.first.head<2>() = weight * area.centroid;
  moments.second.topLeftCorner<2, 2>() =
      weight * (area.covariance + area.centroid * area.centroid.transpose());
  return moments;
}

}  // namespace

geometry::Polygon drawn_in_frame(std::span<const Eigen::Vector3d> corners,
                                 const geometry::PlaneFrame& frame) {
  const Eigen::Isometry3d T_plane_world = frame.T_plane_parent();
  geometry::Ring ring;
  for (const Eigen::Vector3d& corner : corners) {
    const Eigen::Vector2d p = (T_plane_world * corner).head<2>();
    if (p.norm() > kFarthestDrawn) return {};
    ring.push_back(geometry::to_grid(p));
  }
  const std::vector<geometry::Ring> rings = {ring};
  return geometry::from_rings(rings, geometry::FillRule::kNonZero);
}

geometry::Polygon left_of(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                          const geometry::PlaneFrame& frame, const geometry::Polygon& extent) {
  const Eigen::Isometry3d T_plane_world = frame.T_plane_parent();
  const Eigen::Vector2d from = (T_plane_world * p).head<2>(), to = (T_plane_world * q).head<2>();
  const Eigen::Vector2d along = (to - from).normalized();
  const Eigen::AlignedBox2d box = geometry::bounding_box(extent);
  if (!((to - from).norm() > 1e-3)) return {};
  const double length = box.diagonal().norm() + geometry::kGridUnit;
  // The point of the line next to the polygon: numbers stay small however far the line's ends are.
  const Eigen::Vector2d middle = from + along * along.dot(box.center() - from);
  if ((middle - box.center()).norm() > length) return {};
  const Eigen::Vector2d left(-along.y(), along.x());
  const geometry::Ring ring = {geometry::to_grid(middle - length * along),
                               geometry::to_grid(middle + length * along),
                               geometry::to_grid(middle + length * along + 2.0 * length * left),
                               geometry::to_grid(middle - length * along + 2.0 * length * left)};
  const std::vector<geometry::Ring> rings = {ring};
  return geometry::from_rings(rings, geometry::FillRule::kNonZero);
}

std::optional<MapFeature> drawn_feature(const FeatureId& id,
                                        std::span<const Eigen::Vector3d> corners,
                                        const MergeConfig& config) {
  if (corners.size() < 3) return std::nullopt;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& corner : corners) center += corner;
  center /= static_cast<double>(corners.size());
  const Eigen::Vector3d area = area_vector(corners, center);
  if (area.norm() < kLeastDrawnArea) return std::nullopt;

  MapFeature feature;
  feature.id = id;
  feature.observations = {id};
  feature.surface.plane = geometry::Plane::through(center, area.normalized());
  const bool is_flat = std::all_of(corners.begin(), corners.end(), [&](const auto& corner) {
    return std::abs(feature.surface.plane.signed_distance(corner)) <= kOffPlane;
  });
  if (!is_flat) return std::nullopt;
  const Eigen::Vector3d edge = corners[1] - corners[0];
  feature.surface.frame = geometry::PlaneFrame::on(feature.surface.plane, center, edge.normalized(),
                                                   area.cross(edge).normalized());
  feature.surface.polygon = drawn_in_frame(corners, feature.surface.frame);
  const bool is_whole = feature.surface.polygon.parts.size() == 1 &&
                        geometry::area(feature.surface.polygon) > 0.98 * area.norm() &&
                        feature.surface.polygon.parts[0].holes.empty();
  if (!is_whole) return std::nullopt;
  feature.moments =
      even_moments(feature.surface.polygon, 1.0 / (config.sigma_pose * config.sigma_pose));
  feature.inliers = 1;
  if (!refit(feature)) return std::nullopt;
  return feature;
}

}  // namespace geomap::mapping
