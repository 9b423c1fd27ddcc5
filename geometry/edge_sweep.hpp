// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "geometry/polygon.hpp"

namespace geomap::geometry {

/// @brief One edge of one ring, with its bounding box.
struct GridEdge {
  GridEdge(GridPoint from, GridPoint to, std::uint32_t ring_number, std::uint32_t edge_number)
      : a(from),
        b(to),
        min_x(std::min(from.x, to.x)),
        max_x(std::max(from.x, to.x)),
        min_y(std::min(from.y, to.y)),
        max_y(std::max(from.y, to.y)),
        ring(ring_number),
        index(edge_number) {}

  GridPoint a, b;
  std::int32_t min_x, max_x, min_y, max_y;
  std::uint32_t ring;
  std::uint32_t index;  // the edge from vertex `index` to the one after it
};

/// @brief Appends the edges of a ring.
inline void append_edges(const Ring& ring, std::uint32_t ring_number,
                         std::vector<GridEdge>& edges) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    edges.emplace_back(ring[i], ring[i + 1 == ring.size() ? 0 : i + 1], ring_number,
                       static_cast<std::uint32_t>(i));
  }
}

/// @brief True when f begins where e ends, of two edges of one ring with `size` vertices.
inline bool follows(const GridEdge& f, const GridEdge& e, std::size_t size) {
  return f.index == e.index + 1 || (f.index == 0 && e.index + 1 == size);
}

/// @brief Calls visit(e, f) once for every two edges whose boxes meet, until it returns false.
/// Sorts the edges by x, so that outlines cost little more than their number of edges.
template <typename Visit>
void visit_near_pairs(std::vector<GridEdge>& edges, Visit&& visit) {
  std::sort(edges.begin(), edges.end(), [](const GridEdge& e, const GridEdge& f) {
    if (e.min_x != f.min_x) return e.min_x < f.min_x;
    return e.ring != f.ring ? e.ring < f.ring : e.index < f.index;
  });
  for (auto e = edges.begin(); e != edges.end(); ++e) {
    for (auto f = e + 1; f != edges.end() && f->min_x <= e->max_x; ++f) {
      if (f->min_y > e->max_y || f->max_y < e->min_y) continue;
      if (!visit(*e, *f)) return;
    }
  }
}

}  // namespace geomap::geometry
