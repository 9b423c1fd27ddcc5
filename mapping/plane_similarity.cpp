// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/plane_similarity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/angles.hpp"
#include "geometry/offset_rings.hpp"
#include "geometry/polygon_clip.hpp"
#include "mapping/fuse.hpp"

namespace geomap::mapping {
namespace {

using geometry::Plane;

// How well features are known. A single view, however small, is taken to be as good as a view can
// be: that a small patch weighs little in a fusion does not make it likelier to belong anywhere.
// Fits cost more than all other tests of a neighbour together, so they wait until one is asked for.

// Variance of the normal [rad²]; `view` is that of one view's offset [m²].
double angle_variance(const MapFeature& feature, double view) {
  const auto fit = feature.moments.fit(Eigen::Vector3d::UnitZ());
  if (!fit) return 0.0;
  const double sigma = fit->sigma_angle();
  return std::min(sigma * sigma, view / fit->extent.y());
}

// Variance of the offset at a point of the world [m²].
double offset_variance(const MapFeature& feature, double view, const Eigen::Vector3d& at_world) {
  const auto fit = feature.moments.fit(Eigen::Vector3d::UnitZ());
  if (!fit) return 0.0;
  const double sigma = fit->sigma_offset(feature.surface.frame.T_plane_parent() * at_world);
  return std::min(sigma * sigma, view);
}

// Height [m] of a plane above the point `at` of the frame it is given in.
double height_at(const Plane& plane, const Eigen::Vector2d& at) {
  return -(plane.normal.head<2>().dot(at) + plane.d) / plane.normal.z();
}

// Least overlap [m²] of two features: a share of the smaller one, or a common border: half as long
// as its side when half the gap tolerance lies between them, shorter when they touch.
double least_overlap(double smaller, const MergeConfig& config) {
  const double border = 0.5 * config.gap * 0.5 * std::sqrt(smaller);
  return std::max(config.min_overlap_area, std::min(config.min_overlap_share * smaller, border));
}

Eigen::AlignedBox2d extent_in(const geometry::PlaneFrame& frame,
                              const geometry::PlanarPolygon& surface) {
  const Eigen::Isometry3d T_frame_parent = frame.T_plane_parent();
  Eigen::AlignedBox2d box;
  for (const geometry::PolygonPart& part : surface.polygon.parts) {
    for (const geometry::GridPoint vertex : part.outer) {
      box.extend(Eigen::Vector2d((T_frame_parent * surface.lift(vertex)).head<2>()));
    }
  }
  return box;
}

double common_area(const Eigen::AlignedBox2d& a, const Eigen::AlignedBox2d& b) {
  return a.intersects(b) ? a.intersection(b).volume() : 0.0;
}

// Least distance of two planes of one frame along its normal, over a box.
double least_distance(const Plane& a, const Plane& b, const Eigen::AlignedBox2d& box) {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (const auto corner : {Eigen::AlignedBox2d::BottomLeft, Eigen::AlignedBox2d::BottomRight,
                            Eigen::AlignedBox2d::TopLeft, Eigen::AlignedBox2d::TopRight}) {
    const double difference = height_at(a, box.corner(corner)) - height_at(b, box.corner(corner));
    lowest = std::min(lowest, difference);
    highest = std::max(highest, difference);
  }
  return std::max({lowest, -highest, 0.0});
}

// The gates below lie between fixed bounds, so that most pairs are decided without a fit.
bool angles_agree(const MapFeature& a, double view_a, const MapFeature& b, double view_b,
                  double angle, const MergeConfig& config) {
  if (angle <= geometry::radians(config.min_angle_deg)) return true;
  if (angle > geometry::radians(config.max_angle_deg)) return false;
  return angle <= 3.0 * std::sqrt(angle_variance(a, view_a) + angle_variance(b, view_b));
}

bool distances_agree(const MapFeature& a, double view_a, const MapFeature& b, double view_b,
                     double distance, const Eigen::Vector3d& where, const MergeConfig& config) {
  if (distance <= config.min_distance) return true;
  if (distance > config.max_distance) return false;
  return distance <= 3.0 * std::sqrt(offset_variance(a, view_a, where) +
                                     offset_variance(b, view_b, where) + view_a + view_b);
}

// The largest distance [m] that distances_agree() can grant.
double largest_distance(double view_a, double view_b, const MergeConfig& config) {
  return std::clamp(3.0 * std::sqrt(2.0 * (view_a + view_b)), config.min_distance,
                    config.max_distance);
}

}  // namespace

// The difference of their heights is linear, so the area's moments up to the second give it
// exactly.
double rms_distance(const Plane& a, const Plane& b, const geometry::AreaMoments& over) {
  const auto slope = [](const Plane& plane) -> Eigen::Vector2d {
    return -plane.normal.head<2>() / plane.normal.z();
  };
  const double offset = height_at(a, over.centroid) - height_at(b, over.centroid);
  const Eigen::Vector2d turn = slope(a) - slope(b);
  return a.normal.z() * std::sqrt(offset * offset + turn.dot(over.covariance * turn));
}

double merging_reach(const MapFeature& a, const MapFeature& b, const MergeConfig& config) {
  return largest_distance(view_variance(a.moments, config), view_variance(b.moments, config),
                          config);
}

Similarity compare(const MapFeature& a, const MapFeature& b, const MergeConfig& config,
                   ClipMemo& memo, double overlap_to_beat) {
  Similarity result;
  const Plane& plane_a = a.surface.plane;
  const Plane& plane_b = b.surface.plane;
  if (plane_a.normal.dot(plane_b.normal) <= 0.0) {
    result.difference = Difference::kSide;
    return result;
  }

  result.angle = geometry::angle_between(plane_a, plane_b);
  const double view_a = view_variance(a.moments, config);
  const double view_b = view_variance(b.moments, config);
  if (!angles_agree(a, view_a, b, view_b, result.angle, config)) {
    result.difference = Difference::kAngle;
    return result;
  }

  // Most neighbours are ruled out by their boxes, before any clipping.
  const geometry::PlaneFrame& frame = a.surface.frame;
  const Eigen::Isometry3d T_frame_world = frame.T_plane_parent();
  const Plane a_in_frame = plane_a.transformed(T_frame_world);
  const Plane b_in_frame = plane_b.transformed(T_frame_world);
  const Eigen::Vector2d reach =
      Eigen::Vector2d::Constant(geometry::kMitreLimit * config.gap + geometry::kGridUnit);
  const auto grown = [&](const Eigen::AlignedBox2d& box) {
    return Eigen::AlignedBox2d(box.min() - reach, box.max() + reach);
  };
  const Eigen::AlignedBox2d box_a = geometry::bounding_box(a.surface.polygon);
  const Eigen::AlignedBox2d box_b = extent_in(frame, b.surface);
  const Eigen::AlignedBox2d common = grown(box_a).intersection(grown(box_b));
  const double most_overlap =  // only one of them will be grown
      std::max(common_area(grown(box_a), box_b), common_area(box_a, grown(box_b)));
  if (common.isEmpty() || most_overlap < std::max(config.min_overlap_area, overlap_to_beat)) {
    result.difference = Difference::kOverlap;
    return result;
  }
  if (least_distance(a_in_frame, b_in_frame, common) > largest_distance(view_a, view_b, config)) {
    result.difference = Difference::kDistance;
    return result;
  }

  result.b_in_a = memo.in_frame(b.surface, frame);
  const double area_a = geometry::area(a.surface.polygon);
  const double area_b = geometry::area(result.b_in_a);
  const geometry::AreaMoments overlap = memo.overlap(a.surface.polygon, result.b_in_a, config.gap);
  result.overlap = overlap.area;
  if (overlap.area < least_overlap(std::min(area_a, area_b), config)) {
    result.difference = Difference::kOverlap;
    return result;
  }

  result.distance = rms_distance(a_in_frame, b_in_frame, overlap);
  const Eigen::Vector3d where = a.surface.lift(overlap.centroid);
  if (!distances_agree(a, view_a, b, view_b, result.distance, where, config)) {
    result.difference = Difference::kDistance;
  }
  return result;
}

}  // namespace geomap::mapping
