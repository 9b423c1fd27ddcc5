// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/ring_contacts.hpp"

#include <algorithm>

#include "geometry/edge_sweep.hpp"
#include "geometry/grid_predicates.hpp"

namespace geomap::geometry {
namespace {

// The two vertices between which a ring passes through a point.
struct Arms {
  GridPoint before, after;
};

std::size_t after(std::size_t i, const Ring& ring) { return i + 1 == ring.size() ? 0 : i + 1; }
std::size_t before(std::size_t i, const Ring& ring) { return i == 0 ? ring.size() - 1 : i - 1; }

// Arms of a ring at a point of its edge number `index`.
Arms arms_at(GridPoint point, const Ring& ring, std::size_t index) {
  const std::size_t end = after(index, ring);
  if (point == ring[index]) return {ring[before(index, ring)], ring[end]};
  if (point == ring[end]) return {ring[index], ring[after(end, ring)]};
  return {ring[index], ring[end]};
}

// The one common point of two segments that touch.
GridPoint touching_point(const GridEdge& e, const GridEdge& f) {
  const auto on_e = [&](GridPoint p) {
    return orientation(e.a, e.b, p) == 0 && std::min(e.a, e.b) <= p && p <= std::max(e.a, e.b);
  };
  if (on_e(f.a)) return f.a;
  if (on_e(f.b)) return f.b;
  return orientation(f.a, f.b, e.a) == 0 ? e.a : e.b;
}

bool crosses_where_touching(const GridEdge& e, const Ring& e_ring, const GridEdge& f,
                            const Ring& f_ring) {
  const GridPoint point = touching_point(e, f);
  const Arms of_e = arms_at(point, e_ring, e.index), of_f = arms_at(point, f_ring, f.index);
  return left_of_corner(of_e.before, point, of_e.after, of_f.before) !=
         left_of_corner(of_e.before, point, of_e.after, of_f.after);
}

// Two edges of one ring may only meet as neighbours, in their common vertex.
bool breaks_simplicity(const GridEdge& e, const GridEdge& f, std::size_t size) {
  if (e.a == e.b || f.a == f.b) return true;
  const bool e_before_f = follows(f, e, size), f_before_e = follows(e, f, size);
  if (!e_before_f && !f_before_e) return meeting(e.a, e.b, f.a, f.b) != Meeting::kApart;
  const GridEdge& first = e_before_f ? e : f;
  const GridEdge& second = e_before_f ? f : e;
  return orientation(first.a, first.b, second.b) == 0 &&
         dot(first.b, first.a, second.a, second.b) > 0;
}

}  // namespace

RingContacts find_contacts(std::span<const Ring* const> rings) {
  RingContacts found;
  std::vector<GridEdge> edges;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    if (rings[i]->size() < 3) {
      found.not_simple = i;
      return found;
    }
    append_edges(*rings[i], static_cast<std::uint32_t>(i), edges);
  }
  visit_near_pairs(edges, [&](const GridEdge& e, const GridEdge& f) {
    if (e.ring == f.ring) {
      if (breaks_simplicity(e, f, rings[e.ring]->size())) found.not_simple = e.ring;
      return !found.not_simple;
    }
    const Meeting how = meeting(e.a, e.b, f.a, f.b);
    if (how == Meeting::kApart) return true;
    found.touching = true;
    if (how != Meeting::kTouch || crosses_where_touching(e, *rings[e.ring], f, *rings[f.ring])) {
      found.crossing = std::minmax<std::size_t>(e.ring, f.ring);
    }
    return !found.crossing;
  });
  return found;
}

Side locate(GridPoint p, const Ring& ring) {
  bool inside = false;
  GridPoint a = ring.back();
  for (const GridPoint b : ring) {
    if ((a.y > p.y) != (b.y > p.y)) {
      const int side = orientation(a, b, p);
      if (side == 0) return Side::kBorder;
      if ((side > 0) == (b.y > a.y)) inside = !inside;
    } else if (b.y == p.y) {
      const bool along = a.y == p.y && (a.x > p.x) != (b.x > p.x);
      if (along || b.x == p.x) return Side::kBorder;
    }
    a = b;
  }
  return inside ? Side::kInside : Side::kOutside;
}

bool lies_inside(const Ring& inner, const Ring& outer) {
  const GridPoint start = inner[0];
  const Side side = locate(start, outer);
  if (side != Side::kBorder) return side == Side::kInside;
  // Both pass through `start`: the direction in which the inner ring leaves it tells.
  for (std::size_t i = 0; i < outer.size(); ++i) {
    const GridPoint a = outer[i], b = outer[after(i, outer)];
    const bool here =
        orientation(a, b, start) == 0 && std::min(a, b) <= start && start <= std::max(a, b);
    if (!here) continue;
    const Arms arms = arms_at(start, outer, i);
    const bool left = left_of_corner(arms.before, start, arms.after, inner[1]);
    return left == (twice_area(outer) > 0);
  }
  return false;
}

Ring without_collinear(const Ring& ring) {
  Ring kept;
  kept.reserve(ring.size());
  for (const GridPoint p : ring) {
    while (kept.size() >= 2 && orientation(kept[kept.size() - 2], kept.back(), p) == 0) {
      kept.pop_back();
    }
    if (kept.empty() || kept.back() != p) kept.push_back(p);
  }
  // The same where the ring closes: the last vertices, then the first ones.
  std::size_t first = 0;
  for (bool changed = true; changed && kept.size() - first >= 3;) {
    changed = false;
    const GridPoint last = kept.back();
    if (last == kept[first] || orientation(kept[kept.size() - 2], last, kept[first]) == 0) {
      kept.pop_back();
      changed = true;
    } else if (orientation(last, kept[first], kept[first + 1]) == 0) {
      ++first;
      changed = true;
    }
  }
  kept.erase(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(first));
  return kept.size() < 3 ? Ring{} : kept;
}

std::vector<const Ring*> rings_of(const Polygon& polygon) {
  std::vector<const Ring*> rings;
  for (const PolygonPart& part : polygon.parts) {
    rings.push_back(&part.outer);
    for (const Ring& hole : part.holes) rings.push_back(&hole);
  }
  return rings;
}

}  // namespace geomap::geometry
