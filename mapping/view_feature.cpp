// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/view_feature.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace geomap::mapping {
namespace {

using geometry::GridPoint;
using geometry::PlanarPolygon;
using geometry::Polygon;
using geometry::Ring;

constexpr double kNormalUnit = 1e-6;
constexpr double kAxisUnit = 1.0 / 30000.0;
constexpr double kAngleUnit = 1e-5;      // [rad]
constexpr double kAxesTolerance = 1e-3;  // far more than rounding does

template <class Integer>
Integer rounded(double value, double unit) {
  using Limits = std::numeric_limits<Integer>;
  return static_cast<Integer>(std::clamp(std::round(value / unit),
                                         static_cast<double>(Limits::min()),
                                         static_cast<double>(Limits::max())));
}

template <class Integer>
std::array<Integer, 3> rounded(const Eigen::Vector3d& v, double unit) {
  return {rounded<Integer>(v.x(), unit), rounded<Integer>(v.y(), unit),
          rounded<Integer>(v.z(), unit)};
}

template <class Integer>
Eigen::Vector3d vector(const std::array<Integer, 3>& v, double unit) {
  return unit * Eigen::Vector3d(v[0], v[1], v[2]);
}

double squared_distance(const Ring& ring, const Eigen::Vector2d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  Eigen::Vector2d p = geometry::to_metres(ring.back());
  for (const GridPoint vertex : ring) {
    const Eigen::Vector2d q = geometry::to_metres(vertex);
    const Eigen::Vector2d along = q - p;
    const double t = std::clamp((point - p).dot(along) / along.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (p + t * along - point).squaredNorm());
    p = q;
  }
  return nearest;
}

double distance_to_border(const Polygon& polygon, const Eigen::Vector2d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const geometry::PolygonPart& part : polygon.parts) {
    nearest = std::min(nearest, squared_distance(part.outer, point));
    for (const Ring& hole : part.holes) nearest = std::min(nearest, squared_distance(hole, point));
  }
  return std::sqrt(nearest);
}

// Is a vertex of `moved` farther than `distance` from the plane or the border of `surface`?
bool leaves(const PlanarPolygon& moved, const PlanarPolygon& surface, double distance) {
  const Eigen::Isometry3d T_plane_world = surface.frame.T_plane_parent();
  std::vector<GridPoint> corners = geometry::vertices(surface.polygon);
  std::sort(corners.begin(), corners.end());
  const std::vector<GridPoint> vertices = geometry::vertices(moved.polygon);
  return std::any_of(vertices.begin(), vertices.end(), [&](GridPoint vertex) {
    const Eigen::Vector3d p = T_plane_world * moved.lift(vertex);
    if (std::abs(p.z()) > distance) return true;
    // Most vertices of an outline stay for good, which saves the search for the nearest edge.
    const bool is_corner = std::binary_search(corners.begin(), corners.end(), vertex) &&
                           (p.head<2>() - geometry::to_metres(vertex)).norm() <= distance;
    return !is_corner && distance_to_border(surface.polygon, p.head<2>()) > distance;
  });
}

}  // namespace

ViewFeature quantised(const MapFeature& feature) {
  const PlanarPolygon& surface = feature.surface;
  const Eigen::Vector3d& normal = surface.plane.normal;
  const Eigen::Vector3d along = surface.frame.x_axis - surface.frame.x_axis.dot(normal) * normal;
  ViewFeature view;
  view.id = feature.id;
  view.origin = rounded<std::int32_t>(surface.lift(Eigen::Vector2d::Zero()), geometry::kGridUnit);
  view.normal = rounded<std::int32_t>(normal, kNormalUnit);
  view.x_axis = rounded<std::int16_t>(along.normalized(), kAxisUnit);
  view.polygon = surface.polygon;
  view.observations = rounded<std::int16_t>(static_cast<double>(feature.observations.size()), 1.0);
  view.rms = rounded<std::int16_t>(feature.rms, geometry::kGridUnit);
  view.sigma_angle = rounded<std::int16_t>(feature.sigma_angle, kAngleUnit);
  view.sigma_d = rounded<std::int16_t>(feature.sigma_d, geometry::kGridUnit);
  std::transform(feature.color.begin(), feature.color.end(), view.color.begin(),
                 [](double value) { return rounded<std::uint8_t>(value, 1.0); });
  view.locked = feature.is_held();
  view.label = feature.label;
  return view;
}

PlanarPolygon surface_of(const ViewFeature& feature) {
  PlanarPolygon surface;
  surface.frame.origin = vector(feature.origin, geometry::kGridUnit);
  surface.frame.normal = vector(feature.normal, kNormalUnit).normalized();
  const Eigen::Vector3d x = vector(feature.x_axis, kAxisUnit);
  surface.frame.x_axis = (x - x.dot(surface.frame.normal) * surface.frame.normal).normalized();
  surface.plane = surface.frame.plane();
  surface.polygon = feature.polygon;
  return surface;
}

bool is_sound(const ViewFeature& feature) {
  const Eigen::Vector3d normal = vector(feature.normal, kNormalUnit);
  const Eigen::Vector3d x = vector(feature.x_axis, kAxisUnit);
  return std::abs(normal.norm() - 1.0) < kAxesTolerance &&
         std::abs(x.norm() - 1.0) < kAxesTolerance && std::abs(x.dot(normal)) < kAxesTolerance &&
         feature.observations > 0 && feature.rms >= 0 && feature.sigma_angle >= 0 &&
         feature.sigma_d >= 0;
}

bool looks_different(const ViewFeature& sent, const ViewFeature& now,
                     const ViewTolerance& tolerance) {
  if (sent.label != now.label || sent.locked != now.locked) return true;
  const double area = geometry::area(sent.polygon);
  if (std::abs(geometry::area(now.polygon) - area) > tolerance.area_share * area) return true;
  const PlanarPolygon before = surface_of(sent);
  const PlanarPolygon after = surface_of(now);
  return leaves(after, before, tolerance.distance) || leaves(before, after, tolerance.distance);
}

}  // namespace geomap::mapping
