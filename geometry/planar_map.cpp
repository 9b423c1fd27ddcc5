// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/planar_map.hpp"

#include <algorithm>
#include <numeric>

#include "geometry/grid_predicates.hpp"

namespace geomap::geometry {
namespace {

// A walk around a connected area passes a point again where the area touches itself; no two such
// points alternate along it, so that every stretch between two passes is a ring of its own.
void split_at_repeats(const Ring& walk, std::vector<Ring>& rings) {
  Ring sorted = walk;
  std::sort(sorted.begin(), sorted.end());
  const auto number = [&](GridPoint p) {
    return static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), p) -
                                    sorted.begin());
  };
  std::vector<bool> is_open(walk.size(), false);
  Ring path;
  for (const GridPoint p : walk) {
    if (is_open[number(p)]) {
      const auto before = std::find(path.begin(), path.end(), p);
      rings.emplace_back(before, path.end());
      for (auto q = before + 1; q != path.end(); ++q) is_open[number(*q)] = false;
      path.erase(before + 1, path.end());
    } else {
      is_open[number(p)] = true;
      path.push_back(p);
    }
  }
  rings.push_back(std::move(path));
}

}  // namespace

void PlanarMap::link() {
  const auto is_upper = [&](Index h) {
    const GridPoint from = origin(h), to = origin(twin(h));
    return to.y > from.y || (to.y == from.y && to.x > from.x);
  };
  std::vector<Index> around(size());  // by origin, then counter-clockwise from the x axis
  std::iota(around.begin(), around.end(), 0U);
  std::sort(around.begin(), around.end(), [&](Index g, Index h) {
    const GridPoint at = origin(g);
    if (at != origin(h)) return at < origin(h);
    if (is_upper(g) != is_upper(h)) return is_upper(g);
    return orientation(at, origin(twin(g)), origin(twin(h))) > 0;
  });
  next_.resize(size());
  for (std::size_t first = 0; first < around.size();) {
    std::size_t end = first;
    while (end < around.size() && origin(around[end]) == origin(around[first])) ++end;
    for (std::size_t i = first; i < end; ++i) {
      next_[twin(around[i])] = around[i == first ? end - 1 : i - 1];
    }
    first = end;
  }
}

// Winding numbers just above the middle of a fragment: what crosses a vertical ray upwards.
Windings PlanarMap::above(Index fragment) const {
  const Fragment& base = fragments_[fragment];
  const std::int64_t x = std::int64_t{base.a.x} + base.b.x, y = std::int64_t{base.a.y} + base.b.y;
  Windings sum{0, 0};
  for (const Fragment& f : fragments_) {
    if (2 * std::int64_t{f.a.x} > x || 2 * std::int64_t{f.b.x} <= x || &f == &base) continue;
    const Int128 side = Int128{dx(f.a, f.b)} * (y - 2 * std::int64_t{f.a.y}) -
                        Int128{dy(f.a, f.b)} * (x - 2 * std::int64_t{f.a.x});
    if (side >= 0) continue;  // the middle is not below f
    sum[0] -= f.step[0];
    sum[1] -= f.step[1];
  }
  return sum;
}

// One ray for each connected set of fragments; the rest follows from face to face.
void PlanarMap::wind() {
  left_.assign(size(), Windings{0, 0});
  std::vector<bool> known(size(), false);
  std::vector<Index> open;
  const auto set_face = [&](Index start, Windings windings) {
    Index h = start;
    do {
      left_[h] = windings;
      known[h] = true;
      open.push_back(h);
      h = next_[h];
    } while (h != start);
  };
  for (Index k = 0; k < fragments_.size(); ++k) {
    if (known[2 * k] || fragments_[k].a.x == fragments_[k].b.x) continue;
    set_face(2 * k, above(k));
    while (!open.empty()) {
      const Index h = open.back();
      open.pop_back();
      if (known[twin(h)]) continue;
      const Windings& step = fragments_[h / 2].step;
      const int direction = h & 1U ? -1 : 1;
      set_face(twin(h), {left_[h][0] - direction * step[0], left_[h][1] - direction * step[1]});
    }
  }
}

std::vector<Ring> PlanarMap::boundary(InsideRule inside) const {
  std::vector<bool> is_border(size());
  for (Index h = 0; h < size(); ++h) {
    const Windings &l = left_[h], &r = left_[twin(h)];
    is_border[h] = inside(l[0], l[1]) && !inside(r[0], r[1]);
  }
  std::vector<Ring> rings;
  for (Index start = 0; start < size(); ++start) {
    if (!is_border[start]) continue;
    Ring walk;
    for (Index h = start; is_border[h];) {
      walk.push_back(origin(h));
      is_border[h] = false;
      h = next_[h];
      // Turn through the inside about the vertex, up to the next edge with outside beyond it.
      while (!is_border[h] && h != start) h = next_[twin(h)];
    }
    split_at_repeats(walk, rings);
  }
  return rings;
}

}  // namespace geomap::geometry
