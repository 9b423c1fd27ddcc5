// SPDX-License-Identifier: BSD-3-Clause
#include "logs/hull_distance.hpp"

#include <algorithm>
#include <limits>

namespace geomap::logs {
namespace {

double distance_to_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                           const Eigen::Vector2d& b) {
  const Eigen::Vector2d edge = b - a;
  const double along = std::clamp((p - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
  return (p - a - along * edge).norm();
}

double distance_to_border(const Eigen::Vector2d& p, const geometry::Polygon& polygon) {
  double nearest = std::numeric_limits<double>::infinity();
  const auto visit = [&](const geometry::Ring& ring) {
    Eigen::Vector2d last = geometry::to_metres(ring.back());
    for (const geometry::GridPoint vertex : ring) {
      const Eigen::Vector2d next = geometry::to_metres(vertex);
      nearest = std::min(nearest, distance_to_segment(p, last, next));
      last = next;
    }
  };
  for (const geometry::PolygonPart& part : polygon.parts) {
    visit(part.outer);
    for (const geometry::Ring& hole : part.holes) visit(hole);
  }
  return nearest;
}

}  // namespace

std::optional<HullDistance> hull_distance(std::span<const geometry::Polygon> outlines,
                                          const geometry::Polygon& truth) {
  if (truth.empty()) return std::nullopt;
  HullDistance result;
  double sum = 0.0;
  for (const geometry::Polygon& outline : outlines) {
    for (const geometry::PolygonPart& part : outline.parts) {
      for (const geometry::GridPoint vertex : part.outer) {
        const double distance = distance_to_border(geometry::to_metres(vertex), truth);
        sum += distance;
        result.max = std::max(result.max, distance);
        ++result.vertices;
      }
    }
  }
  if (result.vertices == 0) return std::nullopt;
  result.mean = sum / static_cast<double>(result.vertices);
  return result;
}

HullDistance joined(const HullDistance& a, const HullDistance& b) {
  const std::size_t vertices = a.vertices + b.vertices;
  if (vertices == 0) return {};
  const double sum =
      static_cast<double>(a.vertices) * a.mean + static_cast<double>(b.vertices) * b.mean;
  return {vertices, sum / static_cast<double>(vertices), std::max(a.max, b.max)};
}

}  // namespace geomap::logs
