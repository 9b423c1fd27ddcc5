// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/export_svg_view.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/angles.hpp"
#include "mapping/export_features.hpp"

namespace geomap::mapping {
namespace {

constexpr double kObliqueTurn = geometry::radians(35.0);
constexpr double kObliqueDip = geometry::radians(32.0);
constexpr double kEdgeOn = 0.05;  // cosine; such a face is hardly more than a line
constexpr double kDepthTolerance =
    0.03;  // [m] by which faces of a real map reach through each other

Eigen::Vector3d horizontal(double heading) { return {std::cos(heading), std::sin(heading), 0.0}; }

ViewAxes axes_along(double heading, double dip) {
  const Eigen::Vector3d ahead = horizontal(heading);
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  return {ahead.cross(z), std::sin(dip) * ahead + std::cos(dip) * z,
          std::cos(dip) * ahead - std::sin(dip) * z};
}

// Area that the view shows from its front side [m²].
double shown_area(const ViewAxes& axes, std::span<const MapFeature> features) {
  double sum = 0.0;
  for (const MapFeature* feature : sorted_by_id(features)) {
    const double facing = -feature->surface.plane.normal.dot(axes.forward);
    sum += geometry::area(feature->surface.polygon) * std::max(0.0, facing);
  }
  return sum;
}

enum class Side { kBehind, kInFront, kUnclear };

// Where the outline of `a` lies, looked at from the eye, relative to the plane of `b`.
Side side_of(const ProjectedFeature& a, const ProjectedFeature& b) {
  if (std::abs(b.facing) < kEdgeOn) return Side::kUnclear;
  const geometry::PlanarPolygon& surface = a.feature->surface;
  double low = 0.0;
  double high = 0.0;
  for (const geometry::PolygonPart& part : surface.polygon.parts) {
    for (const geometry::GridPoint vertex : part.outer) {
      const double distance = b.feature->surface.plane.signed_distance(surface.lift(vertex));
      low = std::min(low, distance);
      high = std::max(high, distance);
    }
  }
  const bool above = low > -kDepthTolerance && high > kDepthTolerance;
  const bool below = high < kDepthTolerance && low < -kDepthTolerance;
  if (above == below) return Side::kUnclear;
  return above == (b.facing > 0.0) ? Side::kInFront : Side::kBehind;
}

bool must_come_before(const ProjectedFeature& a, const ProjectedFeature& b) {
  const Side a_of_b = side_of(a, b);
  if (a_of_b != Side::kUnclear) return a_of_b == Side::kBehind;
  return side_of(b, a) == Side::kInFront;
}

ProjectedFeature project_feature(const MapFeature& feature, std::size_t number,
                                 const ViewAxes& axes) {
  ProjectedFeature projected;
  projected.feature = &feature;
  projected.number = number;
  projected.facing = -feature.surface.plane.normal.dot(axes.forward);
  std::size_t vertices = 0;
  const auto add = [&](const geometry::Ring& ring) {
    auto& points = projected.rings.emplace_back();
    for (const geometry::GridPoint vertex : ring) {
      const Eigen::Vector3d point = feature.surface.lift(vertex);
      points.push_back(axes.project(point));
      projected.box.extend(points.back());
      projected.depth += axes.forward.dot(point);
      ++vertices;
    }
  };
  for (const geometry::PolygonPart& part : feature.surface.polygon.parts) {
    add(part.outer);
    for (const geometry::Ring& hole : part.holes) add(hole);
  }
  if (vertices > 0) projected.depth /= static_cast<double>(vertices);
  return projected;
}

}  // namespace

double front_heading(std::span<const MapFeature> features) {
  double heading = geometry::radians(90.0);
  double largest = 0.0;
  for (const MapFeature* feature : sorted_by_id(features)) {
    const Eigen::Vector3d& normal = feature->surface.plane.normal;
    const double area = geometry::area(feature->surface.polygon);
    if (std::abs(normal.z()) > std::sin(geometry::radians(15.0)) || area <= largest) continue;
    largest = area;
    heading = std::atan2(-normal.y(), -normal.x());
  }
  return heading;
}

double oblique_turn(std::span<const MapFeature> features, double heading) {
  const double left = shown_area(axes_along(heading + kObliqueTurn, kObliqueDip), features);
  const double right = shown_area(axes_along(heading - kObliqueTurn, kObliqueDip), features);
  return right > left ? -kObliqueTurn : kObliqueTurn;
}

ViewAxes view_axes(SvgView view, double heading, double turn) {
  switch (view) {
    case SvgView::kTop:
      return axes_along(heading, geometry::radians(90.0));
    case SvgView::kFront:
      return axes_along(heading, 0.0);
    case SvgView::kOblique:
      break;
  }
  return axes_along(heading + turn, kObliqueDip);
}

bool is_seen_from_behind(const ProjectedFeature& feature) { return feature.facing < -kEdgeOn; }

std::vector<ProjectedFeature> project_features(std::span<const MapFeature> features,
                                               const ViewAxes& axes) {
  std::vector<ProjectedFeature> projected;
  std::size_t number = 0;
  for (const MapFeature* feature : sorted_by_id(features)) {
    ++number;
    if (feature->surface.polygon.empty()) continue;
    projected.push_back(project_feature(*feature, number, axes));
  }
  return projected;
}

std::vector<std::size_t> paint_order(const std::vector<ProjectedFeature>& features) {
  const std::size_t count = features.size();
  std::vector<std::vector<std::size_t>> later(count);  // what each feature must be painted before
  std::vector<int> waiting(count, 0);
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = 0; b < count; ++b) {
      if (a == b || !features[a].box.intersects(features[b].box)) continue;
      if (!must_come_before(features[a], features[b])) continue;
      later[a].push_back(b);
      ++waiting[b];
    }
  }
  std::vector<std::size_t> order;
  std::vector<bool> done(count, false);
  while (order.size() < count) {
    std::size_t next = count;
    for (std::size_t i = 0; i < count; ++i) {
      if (done[i]) continue;
      // The free ones first; when a cycle leaves none free, the deepest one breaks it.
      const auto is_better = [&](std::size_t j) {
        if ((waiting[i] == 0) != (waiting[j] == 0)) return waiting[i] == 0;
        return features[i].depth > features[j].depth;
      };
      if (next == count || is_better(next)) next = i;
    }
    done[next] = true;
    order.push_back(next);
    for (const std::size_t b : later[next]) --waiting[b];
  }
  return order;
}

}  // namespace geomap::mapping
