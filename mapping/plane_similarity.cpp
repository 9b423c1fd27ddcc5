// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/plane_similarity.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/polygon_clip.hpp"
#include "mapping/fuse.hpp"

namespace geomap::mapping {
namespace {

using geometry::Plane;
using geometry::PlaneFit;

constexpr double kRadiansPerDegree = 0.017453292519943295;

// How well a feature is known. A single view, however small, is taken to be as good as a view can
// be: that a small patch weighs little in a fusion does not make it likelier to belong anywhere.
struct Uncertainty {
  double view = 0.0;    // variance of one view's offset [m²]
  double angle = 0.0;   // variance of the normal [rad²]
  double offset = 0.0;  // variance of the offset at a point [m²]
};

Uncertainty uncertainty(const MapFeature& feature, const Eigen::Vector3d& at_world,
                        const MergeConfig& config) {
  Uncertainty result;
  result.view = view_variance(feature.moments, config);
  const auto fit = feature.moments.fit(Eigen::Vector3d::UnitZ());
  if (!fit) return result;
  const double sigma_angle = fit->sigma_angle();
  const double sigma_offset = fit->sigma_offset(feature.surface.frame.T_plane_parent() * at_world);
  result.angle = std::min(sigma_angle * sigma_angle, result.view / fit->extent.y());
  result.offset = std::min(sigma_offset * sigma_offset, result.view);
  return result;
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

  const Eigen::Vector3d between =
      0.5 * (a.surface.frame.origin + b.surface.frame.origin);  // the angle is the same everywhere
  const double angle_variance =
      uncertainty(a, between, config).angle + uncertainty(b, between, config).angle;
  const double angle_limit =
      std::clamp(3.0 * std::sqrt(angle_variance), config.min_angle_deg * kRadiansPerDegree,
                 config.max_angle_deg * kRadiansPerDegree);
  result.angle = geometry::angle_between(plane_a, plane_b);
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
  const Uncertainty of_a = uncertainty(a, where, config);
  const Uncertainty of_b = uncertainty(b, where, config);
  const double distance_limit =
      std::clamp(3.0 * std::sqrt(of_a.offset + of_b.offset + of_a.view + of_b.view),
                 config.min_distance, config.max_distance);
  if (result.distance > distance_limit) result.difference = Difference::kDistance;
  return result;
}

}  // namespace geomap::mapping
