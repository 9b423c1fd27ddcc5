// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/random_polygons.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/polygon_clip.hpp"

namespace geomap::testing {

using geometry::GridPoint;
using geometry::Polygon;
using geometry::Ring;

namespace {

// Calls visit(p, q) for every edge [m].
template <typename Visit>
void visit_edges(const Polygon& polygon, Visit&& visit) {
  const auto visit_ring = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      visit(to_metres(ring[i]), to_metres(ring[(i + 1) % ring.size()]));
    }
  };
  for (const geometry::PolygonPart& part : polygon.parts) {
    visit_ring(part.outer);
    for (const Ring& hole : part.holes) visit_ring(hole);
  }
}

}  // namespace

std::int32_t RandomShapes::below(std::int32_t bound) {
  return static_cast<std::int32_t>(generator_() % static_cast<std::uint32_t>(bound));
}

double RandomShapes::between(double from, double to) {
  return from + (to - from) * (static_cast<double>(generator_()) / 4294967296.0);
}

double RandomShapes::normal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - between(0.0, 1.0)));
  return radius * std::cos(between(0.0, 2.0 * std::numbers::pi));
}

Ring RandomShapes::coarse_ring(int corners, std::int32_t step) {
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    const std::int32_t x = below(12) * step;
    ring.push_back({x, below(12) * step});
  }
  return ring;
}

Polygon RandomShapes::coarse_polygon(std::int32_t step) {
  const Ring first = coarse_ring(8, step);
  return polygon_of({first, coarse_ring(5, step)});
}

Ring RandomShapes::jagged_ring(int corners, double roughness, const Eigen::Vector2d& center,
                               double radius) {
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    const double r = radius * (1.0 + between(-roughness, roughness));
    ring.push_back(
        geometry::to_grid(center + r * Eigen::Vector2d(std::cos(angle), std::sin(angle))));
  }
  return ring;
}

Polygon RandomShapes::jagged_polygon(int corners, double roughness, const Eigen::Vector2d& center) {
  const Ring outer = jagged_ring(corners, roughness, center);
  return polygon_of({outer, jagged_ring(corners / 2 + 2, roughness, center, 0.4)});
}

Ring box_ring(std::int32_t left, std::int32_t lower, std::int32_t right, std::int32_t upper) {
  return {{left, lower}, {right, lower}, {right, upper}, {left, upper}};
}

Polygon polygon_of(const std::vector<Ring>& rings) {
  return from_rings(rings, geometry::FillRule::kEvenOdd);
}

Polygon shifted(Polygon polygon, std::int32_t x, std::int32_t y) {
  const auto shift = [&](Ring& ring) {
    for (GridPoint& p : ring) p = {p.x + x, p.y + y};
  };
  for (geometry::PolygonPart& part : polygon.parts) {
    shift(part.outer);
    std::for_each(part.holes.begin(), part.holes.end(), shift);
  }
  return polygon;
}

double outline_length(const Polygon& polygon) {
  double length = 0.0;
  visit_edges(polygon, [&](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
    length += (q - p).norm();
  });
  return length;
}

double distance_to_outline(const Polygon& polygon, const Eigen::Vector2d& point) {
  double least = std::numeric_limits<double>::infinity();
  visit_edges(polygon, [&](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
    const double t = std::clamp((q - p).dot(point - p) / (q - p).squaredNorm(), 0.0, 1.0);
    least = std::min(least, (p + t * (q - p) - point).norm());
  });
  return least;
}

}  // namespace geomap::testing
