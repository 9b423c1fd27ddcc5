// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/plane_similarity.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/polygon_clip.hpp"

namespace geomap::mapping {
namespace {

using geometry::Plane;
using geometry::PlaneFit;

constexpr double kRadiansPerDegree = 0.017453292519943295;

// Standard deviation [m] of a feature's offset at a point of the world, from its fit in its own
// frame.
double sigma_offset(const MapFeature& feature, const Eigen::Vector3d& p_world) {
  const auto fit = feature.moments.fit(Eigen::Vector3d::UnitZ());
  return fit ? fit->sigma_offset(feature.surface.frame.T_plane_parent() * p_world) : 0.0;
}

// Rms over an area of the distance between two planes, both given in the area's frame: the
// difference of their heights is linear, so the area's moments up to the second give it exactly.
double rms_distance(const Plane& a, const Plane& b, const geometry::AreaMoments& over) {
  const auto height = [&](const Plane& plane) {
    return -(plane.normal.head<2>().dot(over.centroid) + plane.d) / plane.normal.z();
  };
  const auto slope = [](const Plane& plane) -> Eigen::Vector2d {
    return -plane.normal.head<2>() / plane.normal.z();
  };
  const double offset = height(a) - height(b);
  const Eigen::Vector2d turn = slope(a) - slope(b);
  return a.normal.z() * std::sqrt(offset * offset + turn.dot(over.covariance * turn));
}

// Least overlap [m²] of two features: a share of the smaller one, or a common border half as long
// as its side, which the gap tolerance has widened by half a gap.
double least_overlap(double smaller, const MergeConfig& config) {
  const double border = 0.5 * config.gap * 0.5 * std::sqrt(smaller);
  return std::max(config.min_overlap_area, std::min(config.min_overlap_share * smaller, border));
}

}  // namespace

Similarity compare(const MapFeature& a, const MapFeature& b, const MergeConfig& config) {
  Similarity result;
  const Plane& plane_a = a.surface.plane;
  const Plane& plane_b = b.surface.plane;
  if (plane_a.normal.dot(plane_b.normal) <= 0.0) {
    result.difference = Difference::kSide;
    return result;
  }

  result.angle = geometry::angle_between(plane_a, plane_b);
  const double angle_limit = std::clamp(3.0 * std::hypot(a.sigma_angle, b.sigma_angle),
                                        config.min_angle_deg * kRadiansPerDegree,
                                        config.max_angle_deg * kRadiansPerDegree);
  if (result.angle > angle_limit) {
    result.difference = Difference::kAngle;
    return result;
  }

  const geometry::PlaneFrame& frame = a.surface.frame;
  result.b_in_a = b.surface.in_frame(frame);
  const geometry::AreaMoments overlap = geometry::area_moments(
      geometry::intersect(geometry::offset(a.surface.polygon, 0.5 * config.gap),
                          geometry::offset(result.b_in_a, 0.5 * config.gap)));
  result.overlap = overlap.area;
  const double smaller = std::min(geometry::area(a.surface.polygon), geometry::area(result.b_in_a));
  if (overlap.area < least_overlap(smaller, config)) {
    result.difference = Difference::kOverlap;
    return result;
  }

  const Eigen::Isometry3d T_frame_world = frame.T_plane_parent();
  result.distance =
      rms_distance(plane_a.transformed(T_frame_world), plane_b.transformed(T_frame_world), overlap);
  const Eigen::Vector3d where = a.surface.lift(overlap.centroid);
  const double sigma_a = sigma_offset(a, where);
  const double sigma_b = sigma_offset(b, where);
  const double distance_limit =
      std::clamp(3.0 * std::sqrt(sigma_a * sigma_a + sigma_b * sigma_b +
                                 2.0 * config.sigma_pose * config.sigma_pose),
                 config.min_distance, config.max_distance);
  if (result.distance > distance_limit) result.difference = Difference::kDistance;
  return result;
}

}  // namespace geomap::mapping
