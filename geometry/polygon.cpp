// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/grid_predicates.hpp"
#include "geometry/ring_contacts.hpp"

namespace geomap::geometry {
namespace {

using Eigen::Vector2d;

constexpr double kFarthest = 1e5;      // largest coordinate that is put on the grid [m]
constexpr double kBorderWidth = 1e-3;  // a point this near to an edge lies on it [grid unit]

std::int32_t to_grid(double metres) {
  return static_cast<std::int32_t>(std::floor(metres / kGridUnit + 0.5));
}

// Calls visit(p, q) for every edge of the polygon, as offsets from `origin` [grid unit].
template <typename Visit>
void visit_edges(const Polygon& polygon, const Vector2d& origin, Visit&& visit) {
  for (const Ring* ring : rings_of(polygon)) {
    Vector2d p = Vector2d(ring->back().x, ring->back().y) - origin;
    for (const GridPoint vertex : *ring) {
      const Vector2d q = Vector2d(vertex.x, vertex.y) - origin;
      visit(p, q);
      p = q;
    }
  }
}

double cross(const Vector2d& p, const Vector2d& q) { return p.x() * q.y() - p.y() * q.x(); }

bool is_near_segment(const Vector2d& p, const Vector2d& q, const Vector2d& point) {
  const Vector2d along = q - p;
  const double t = std::clamp(along.dot(point - p) / along.squaredNorm(), 0.0, 1.0);
  return (p + t * along - point).squaredNorm() <= kBorderWidth * kBorderWidth;
}

Ring from_smallest_vertex(Ring ring) {
  std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()), ring.end());
  return ring;
}

}  // namespace

GridPoint to_grid(const Vector2d& point) {
  if (!(std::abs(point.x()) <= kFarthest && std::abs(point.y()) <= kFarthest)) {
    throw std::invalid_argument("polygon vertex is not finite or beyond 100 km");
  }
  return {to_grid(point.x()), to_grid(point.y())};
}

double signed_area(const Ring& ring) {
  return 0.5 * static_cast<double>(twice_area(ring)) * kGridUnit * kGridUnit;
}

double area(const Polygon& polygon) {
  Int128 sum = 0;
  for (const Ring* ring : rings_of(polygon)) sum += twice_area(*ring);
  return 0.5 * static_cast<double>(sum) * kGridUnit * kGridUnit;
}

// Green's theorem: first about a vertex for area and centroid, then about the centroid for the
// second moments, so that nothing cancels far from the frame's origin.
AreaMoments area_moments(const Polygon& polygon) {
  AreaMoments result;
  if (polygon.empty()) return result;
  const GridPoint start = polygon.parts[0].outer[0];
  const Vector2d origin(start.x, start.y);
  double twice = 0.0;
  Vector2d first = Vector2d::Zero();
  visit_edges(polygon, origin, [&](const Vector2d& p, const Vector2d& q) {
    twice += cross(p, q);
    first += cross(p, q) * (p + q);
  });
  if (!(twice > 0.0)) return result;
  const Vector2d centroid = first / (3.0 * twice);
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  visit_edges(polygon, origin + centroid, [&](const Vector2d& p, const Vector2d& q) {
    const Vector2d sum = p + q;
    second += cross(p, q) * (p * p.transpose() + q * q.transpose() + sum * sum.transpose());
  });
  result.area = 0.5 * twice * kGridUnit * kGridUnit;
  result.centroid = (origin + centroid) * kGridUnit;
  result.covariance = second / (12.0 * twice) * kGridUnit * kGridUnit;
  return result;
}

std::vector<GridPoint> vertices(const Polygon& polygon) {
  std::vector<GridPoint> vertices;
  for (const PolygonPart& part : polygon.parts) {
    vertices.insert(vertices.end(), part.outer.begin(), part.outer.end());
    for (const Ring& hole : part.holes) vertices.insert(vertices.end(), hole.begin(), hole.end());
  }
  return vertices;
}

std::size_t vertex_count(const Polygon& polygon) {
  std::size_t count = 0;
  for (const Ring* ring : rings_of(polygon)) count += ring->size();
  return count;
}

Eigen::AlignedBox2d bounding_box(const Polygon& polygon) {
  Eigen::AlignedBox2d box;
  for (const PolygonPart& part : polygon.parts) {
    for (const GridPoint vertex : part.outer) box.extend(to_metres(vertex));
  }
  return box;
}

bool contains(const Polygon& polygon, const Vector2d& point) {
  bool inside = false, on_border = false;
  visit_edges(polygon, point / kGridUnit, [&](const Vector2d& p, const Vector2d& q) {
    on_border = on_border || is_near_segment(p, q, Vector2d::Zero());
    if ((p.y() > 0.0) != (q.y() > 0.0) && (cross(p, q) > 0.0) == (q.y() > p.y())) {
      inside = !inside;
    }
  });
  return inside || on_border;
}

bool is_simple(const Ring& ring) {
  const Ring* const only[] = {&ring};
  return !find_contacts(only).not_simple;
}

std::string find_fault(const Polygon& polygon) {
  const std::vector<const Ring*> rings = rings_of(polygon);
  if (std::any_of(rings.begin(), rings.end(), [](const Ring* r) { return r->size() < 3; })) {
    return "a ring has fewer than three vertices";
  }
  const RingContacts contacts = find_contacts(rings);
  if (contacts.not_simple) return "a ring crosses or touches itself";
  if (contacts.crossing) return "two rings cross or share a stretch";
  return find_nesting_fault(polygon);
}

std::string find_nesting_fault(const Polygon& polygon) {
  const auto& parts = polygon.parts;
  for (const PolygonPart& part : parts) {
    if (twice_area(part.outer) < 0) return "an outer ring runs clockwise";
    for (const Ring& hole : part.holes) {
      if (twice_area(hole) > 0) return "a hole runs counter-clockwise";
    }
  }
  for (const PolygonPart& part : parts) {
    for (auto hole = part.holes.begin(); hole != part.holes.end(); ++hole) {
      if (!lies_inside(*hole, part.outer)) return "a hole lies outside its outer ring";
      for (auto other = part.holes.begin(); other != part.holes.end(); ++other) {
        if (hole != other && lies_inside(*hole, *other)) return "a hole lies inside another hole";
      }
    }
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t j = 0; j < parts.size(); ++j) {
      if (i == j || !lies_inside(parts[i].outer, parts[j].outer)) continue;
      const bool in_a_hole =
          std::any_of(parts[j].holes.begin(), parts[j].holes.end(),
                      [&](const Ring& hole) { return lies_inside(parts[i].outer, hole); });
      if (!in_a_hole) return "a part lies inside another part";
    }
  }
  return {};
}

Polygon canonical(Polygon polygon) {
  for (PolygonPart& part : polygon.parts) {
    part.outer = from_smallest_vertex(std::move(part.outer));
    for (Ring& hole : part.holes) hole = from_smallest_vertex(std::move(hole));
    std::sort(part.holes.begin(), part.holes.end());
  }
  std::sort(polygon.parts.begin(), polygon.parts.end());
  return polygon;
}

}  // namespace geomap::geometry
