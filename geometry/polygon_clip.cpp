// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/polygon_clip.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "geometry/crossing_overlay.hpp"
#include "geometry/grid_predicates.hpp"
#include "geometry/offset_rings.hpp"
#include "geometry/ring_contacts.hpp"
#include "geometry/snap_overlay.hpp"

namespace geomap::geometry {
namespace {

constexpr int kSliver = 100;  // least area of a part or hole: 1 mm² [grid unit²]

constexpr InsideRule kUnion = [](int a, int b) { return a != 0 || b != 0; };
constexpr InsideRule kIntersection = [](int a, int b) { return a != 0 && b != 0; };
constexpr InsideRule kDifference = [](int a, int b) { return a != 0 && b == 0; };
constexpr InsideRule kEvenOdd = [](int a, int) { return a % 2 != 0; };
constexpr InsideRule kPositive = [](int a, int) { return a > 0; };

void append_rings(const Polygon& polygon, std::vector<Ring>& rings) {
  for (const Ring* ring : rings_of(polygon)) rings.push_back(*ring);
}

std::vector<Ring> copied_rings(const Polygon& polygon) {
  std::vector<Ring> rings;
  append_rings(polygon, rings);
  return rings;
}

// Without parts and holes below 1 mm².
Polygon without_slivers(Polygon polygon) {
  const auto net_area = [](const PolygonPart& part) {
    Int128 sum = twice_area(part.outer);
    for (const Ring& hole : part.holes) sum += twice_area(hole);
    return sum;
  };
  for (PolygonPart& part : polygon.parts) {
    std::erase_if(part.holes, [](const Ring& hole) { return -twice_area(hole) < 2 * kSliver; });
  }
  std::erase_if(polygon.parts,
                [&](const PolygonPart& part) { return net_area(part) < 2 * kSliver; });
  return polygon;
}

// Nothing where rings touch themselves or each other since their crossings were rounded to the
// grid: their nesting cannot be relied upon then, and would not be unique.
std::optional<Polygon> to_polygon(const std::optional<TracedBorder>& border) {
  if (!border) return {};
  Polygon polygon = without_slivers(assemble_parts(border->rings));
  const bool is_sound = !border->has_crossings || (find_contacts(rings_of(polygon)).none() &&
                                                   find_nesting_fault(polygon).empty());
  return is_sound ? std::optional(std::move(polygon)) : std::nullopt;
}

Polygon clip(std::span<const Ring> rings, InsideRule inside) {
  auto result = to_polygon(trace_overlay(rings, inside));
  return result ? *std::move(result) : without_slivers(snap_overlay(rings, {}, inside));
}

Polygon clip(const Polygon& a, const Polygon& b, InsideRule inside) {
  auto result = to_polygon(trace_overlay(a, b, inside));
  return result ? *std::move(result)
                : without_slivers(snap_overlay(copied_rings(a), copied_rings(b), inside));
}

// Their order must not matter.
Polygon clip_ordered(const Polygon& a, const Polygon& b, InsideRule inside) {
  return a < b ? clip(a, b, inside) : clip(b, a, inside);
}

bool boxes_apart(const Polygon& a, const Polygon& b) {
  const Eigen::AlignedBox2d box_a = bounding_box(a), box_b = bounding_box(b);
  return (box_a.min().array() > box_b.max().array()).any() ||
         (box_b.min().array() > box_a.max().array()).any();
}

// Throws where a grown polygon would leave the grid.
void check_offset(const Polygon& polygon, double units) {
  constexpr double kLargest = std::numeric_limits<std::int32_t>::max();
  if (!std::isfinite(units)) throw std::invalid_argument("polygon offset is not finite");
  const double reach = std::max(units, 0.0) * kMitreLimit + 1.0;
  const Eigen::AlignedBox2d box = bounding_box(polygon);
  const double farthest =
      std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  if (farthest / kGridUnit + reach > kLargest) {
    throw std::invalid_argument("polygon offset leaves the grid");
  }
}

}  // namespace

Polygon from_rings(std::span<const Ring> rings, FillRule rule) {
  return clip(rings, rule == FillRule::kEvenOdd ? kEvenOdd : kUnion);
}

Polygon unite(const Polygon& a, const Polygon& b) {
  if (a.empty()) return canonical(b);
  if (b.empty() || a == b) return canonical(a);
  if (boxes_apart(a, b)) {
    Polygon both = a;
    both.parts.insert(both.parts.end(), b.parts.begin(), b.parts.end());
    return canonical(std::move(both));
  }
  return clip_ordered(a, b, kUnion);
}

Polygon unite(std::span<const Polygon> polygons) {
  std::vector<Ring> rings;
  for (const Polygon& polygon : polygons) append_rings(polygon, rings);
  std::sort(rings.begin(), rings.end());
  return clip(rings, kUnion);
}

Polygon intersect(const Polygon& a, const Polygon& b) {
  if (a.empty() || b.empty() || boxes_apart(a, b)) return {};
  if (a == b) return canonical(a);
  return clip_ordered(a, b, kIntersection);
}

Polygon subtract(const Polygon& a, const Polygon& b) {
  if (a.empty() || a == b) return {};
  if (b.empty() || boxes_apart(a, b)) return canonical(a);
  return clip(a, b, kDifference);
}

Polygon offset(const Polygon& polygon, double distance) {
  const double units = distance / kGridUnit;
  if (polygon.empty()) return {};
  check_offset(polygon, units);
  return clip(offset_rings(polygon, units), kPositive);
}

}  // namespace geomap::geometry
