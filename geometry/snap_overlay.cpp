// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/snap_overlay.hpp"

#include <compare>

#include "geometry/edge_sweep.hpp"
#include "geometry/grid_predicates.hpp"
#include "geometry/planar_map.hpp"
#include "geometry/ring_contacts.hpp"

namespace geomap::geometry {
namespace {

// Cells that hold a vertex or an intersection, sorted.
std::vector<GridPoint> hot_cells(std::vector<GridEdge>& edges) {
  std::vector<GridPoint> cells;
  for (const GridEdge& edge : edges) cells.push_back(edge.a);
  visit_near_pairs(edges, [&](const GridEdge& e, const GridEdge& f) {
    if (meeting(e.a, e.b, f.a, f.b) == Meeting::kCross)
      cells.push_back(crossing_cell(e.a, e.b, f.a, f.b));
    return true;
  });
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

struct Fraction {
  std::int64_t numerator, denominator;  // denominator > 0
};

std::strong_ordering operator<=>(const Fraction& p, const Fraction& q) {
  const Int128 left = Int128{p.numerator} * q.denominator;
  const Int128 right = Int128{q.numerator} * p.denominator;
  return left <=> right;
}

// The stretch of an edge, as parameters in [0, 1], that lies in a cell.
class Stretch {
 public:
  // Keeps what satisfies -1/2 <= offset + t·step < 1/2.
  void clip(std::int64_t offset, std::int64_t step) {
    const std::int64_t least = -1 - 2 * offset, bound = 1 - 2 * offset;  // on 2·t·step
    if (step == 0) {
      empty_ = empty_ || least > 0 || bound <= 0;
    } else if (step > 0) {
      raise({least, 2 * step}, false);
      lower({bound, 2 * step}, true);
    } else {
      raise({-bound, -2 * step}, true);
      lower({-least, -2 * step}, false);
    }
  }

  bool empty() const {
    const auto order = from_ <=> to_;
    return empty_ || order > 0 || (order == 0 && (from_open_ || to_open_));
  }

 private:
  void raise(Fraction bound, bool open) {
    const auto order = bound <=> from_;
    if (order < 0) return;
    from_open_ = open || (order == 0 && from_open_);
    from_ = bound;
  }
  void lower(Fraction bound, bool open) {
    const auto order = bound <=> to_;
    if (order > 0) return;
    to_open_ = open || (order == 0 && to_open_);
    to_ = bound;
  }

  Fraction from_{0, 1}, to_{1, 1};
  bool from_open_ = false, to_open_ = false, empty_ = false;
};

// Cells are half open (lower and left sides belong to them), so that every point has one cell.
bool passes_through(const GridEdge& edge, GridPoint cell) {
  Stretch stretch;
  stretch.clip(dx(cell, edge.a), dx(edge.a, edge.b));
  stretch.clip(dy(cell, edge.a), dy(edge.a, edge.b));
  return !stretch.empty();
}

// Leads an edge through the hot cells on its way and appends the pieces.
void append_fragments(const GridEdge& edge, const std::vector<GridPoint>& hot,
                      std::vector<Fragment>& fragments) {
  std::vector<std::pair<Int128, GridPoint>> way;  // by progress along the edge
  const GridPoint first{edge.min_x, edge.min_y};
  for (auto cell = std::lower_bound(hot.begin(), hot.end(), first);
       cell != hot.end() && cell->x <= edge.max_x; ++cell) {
    if (cell->y < edge.min_y || cell->y > edge.max_y || !passes_through(edge, *cell)) continue;
    way.emplace_back(dot(edge.a, edge.b, edge.a, *cell), *cell);
  }
  std::sort(way.begin(), way.end());
  for (std::size_t i = 1; i < way.size(); ++i) {
    const GridPoint from = way[i - 1].second, to = way[i].second;
    Fragment fragment{std::min(from, to), std::max(from, to), {0, 0}};
    fragment.step[edge.ring] = from < to ? 1 : -1;
    fragments.push_back(fragment);
  }
}

// Fragments of all edges, equal ones added up, those that change nothing left out.
std::vector<Fragment> rounded_fragments(std::vector<GridEdge>& edges) {
  const std::vector<GridPoint> hot = hot_cells(edges);
  std::vector<Fragment> all;
  for (const GridEdge& edge : edges) append_fragments(edge, hot, all);
  std::sort(all.begin(), all.end(), [](const Fragment& f, const Fragment& g) {
    return f.a != g.a ? f.a < g.a : f.b < g.b;
  });
  std::vector<Fragment> merged;
  for (const Fragment& fragment : all) {
    if (merged.empty() || merged.back().a != fragment.a || merged.back().b != fragment.b) {
      merged.push_back(fragment);
    } else {
      merged.back().step[0] += fragment.step[0];
      merged.back().step[1] += fragment.step[1];
    }
  }
  std::erase_if(merged, [](const Fragment& f) { return f.step == Windings{0, 0}; });
  return merged;
}

}  // namespace

Polygon snap_overlay(std::span<const Ring> a, std::span<const Ring> b, InsideRule inside) {
  std::vector<GridEdge> edges;
  for (const Ring& ring : a) append_edges(ring, 0, edges);
  for (const Ring& ring : b) append_edges(ring, 1, edges);
  std::erase_if(edges, [](const GridEdge& edge) { return edge.a == edge.b; });
  return assemble_parts(PlanarMap(rounded_fragments(edges)).boundary(inside));
}

Polygon assemble_parts(const std::vector<Ring>& rings) {
  Polygon result;
  std::vector<Ring> holes;
  for (const Ring& ring : rings) {
    Ring corners = without_collinear(ring);
    if (corners.empty()) continue;
    if (twice_area(corners) > 0) {
      result.parts.push_back({std::move(corners), {}});
    } else {
      holes.push_back(std::move(corners));
    }
  }
  std::sort(result.parts.begin(), result.parts.end(), [](const auto& p, const auto& q) {
    const Int128 p_area = twice_area(p.outer), q_area = twice_area(q.outer);
    return p_area != q_area ? p_area < q_area : p.outer < q.outer;
  });
  for (Ring& hole : holes) {
    const auto owner =
        std::find_if(result.parts.begin(), result.parts.end(),
                     [&](const PolygonPart& part) { return lies_inside(hole, part.outer); });
    if (owner != result.parts.end()) owner->holes.push_back(std::move(hole));
  }
  return canonical(std::move(result));
}

}  // namespace geomap::geometry
