// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/polygon_simplify.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/grid_predicates.hpp"
#include "geometry/outline_collapse.hpp"
#include "geometry/ring_contacts.hpp"

namespace geomap::geometry {
namespace {

constexpr int kAttempts = 4;  // each with half the tolerance of the one before

using FixedRule = std::function<bool(GridPoint)>;

bool is_free(const Ring& ring, const FixedRule& is_fixed) {
  return !is_fixed || std::none_of(ring.begin(), ring.end(), is_fixed);
}

// Without holes and parts smaller than tolerance², unless a vertex of theirs is fixed.
Polygon without_small(Polygon polygon, double tolerance, const FixedRule& is_fixed) {
  const auto is_small = [&](const Ring& ring) {
    return std::abs(signed_area(ring)) < tolerance * tolerance && is_free(ring, is_fixed);
  };
  std::erase_if(polygon.parts, [&](const PolygonPart& part) { return is_small(part.outer); });
  for (PolygonPart& part : polygon.parts) std::erase_if(part.holes, is_small);
  return polygon;
}

Polygon collapsed(const Polygon& polygon, double tolerance, const FixedRule& is_fixed) {
  Polygon result = without_small(polygon, tolerance, is_fixed);
  std::vector<Ring> rings;
  for (const Ring* ring : rings_of(result)) rings.push_back(*ring);
  OutlineCollapse outline(std::move(rings), tolerance / kGridUnit, is_fixed);
  outline.run();
  const std::vector<Ring> reduced = outline.rings();
  auto next = reduced.begin();
  for (PolygonPart& part : result.parts) {
    part.outer = without_collinear(*next++);
    for (Ring& hole : part.holes) hole = without_collinear(*next++);
  }
  return canonical(std::move(result));
}

}  // namespace

Polygon simplify(const Polygon& polygon, double tolerance, const FixedRule& is_fixed) {
  if (!(tolerance >= 0.0 && std::isfinite(tolerance))) {
    throw std::invalid_argument("simplification needs a tolerance of zero or more");
  }
  // The steps taken are checked one by one; dropping a hole around a part that stays is not.
  double allowed = tolerance;
  for (int attempt = 0; attempt < kAttempts; ++attempt, allowed /= 2.0) {
    Polygon result = collapsed(polygon, allowed, is_fixed);
    if (find_nesting_fault(result).empty()) return result;
  }
  return canonical(polygon);
}

}  // namespace geomap::geometry
