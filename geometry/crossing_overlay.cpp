// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/crossing_overlay.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>
#include <utility>

#include "geometry/edge_sweep.hpp"
#include "geometry/grid_predicates.hpp"
#include "geometry/ring_contacts.hpp"

namespace geomap::geometry {
namespace {

// Where a ring passes through a crossing.
struct Passage {
  std::uint32_t ring, edge;
  double progress;  // along the edge, 0 to 1
  std::uint32_t crossing;
  std::uint32_t operand;  // whose ring is crossed,
  int step;               // which adds this to that operand's winding number
};

// The way along a ring from one of its passages to the next, or back.
struct Stretch {
  const Passage* first = nullptr;
  const Passage* last = nullptr;
  bool is_forward = true;

  std::uint32_t start() const { return is_forward ? first->crossing : last->crossing; }
  std::uint32_t end() const { return is_forward ? last->crossing : first->crossing; }
};

// Where the border of the area passes through a crossing.
struct Joint {
  bool is_reached = false;
  std::optional<Stretch> leaving;
};

struct GridBox {
  explicit GridBox(std::span<const Ring* const> rings) {
    for (const Ring* ring : rings) {
      for (const GridPoint p : *ring) {
        lower = {std::min(lower.x, p.x), std::min(lower.y, p.y)};
        upper = {std::max(upper.x, p.x), std::max(upper.y, p.y)};
      }
    }
  }
  bool holds(GridPoint p) const {
    return lower.x <= p.x && p.x <= upper.x && lower.y <= p.y && p.y <= upper.y;
  }
  bool meets(const GridEdge& edge) const {
    return edge.min_x <= upper.x && edge.max_x >= lower.x && edge.min_y <= upper.y &&
           edge.max_y >= lower.y;
  }

  using Limits = std::numeric_limits<std::int32_t>;
  GridPoint lower{Limits::max(), Limits::max()}, upper{Limits::min(), Limits::min()};
};

// Of a ring about a point that is not on it.
int winding_number(const Ring& ring, GridPoint p) {
  int winding = 0;
  GridPoint a = ring.back();
  for (const GridPoint b : ring) {
    if ((a.y > p.y) != (b.y > p.y)) {
      const int upward = b.y > a.y ? 1 : -1;
      if (orientation(a, b, p) == upward) winding += upward;
    }
    a = b;
  }
  return winding;
}

class Tracer {
 public:
  // Rings of one operand are not compared with each other where they are known not to cross.
  Tracer(std::span<const Ring* const> a, std::span<const Ring* const> b, bool operands_are_simple,
         InsideRule inside)
      : rings_(a.begin(), a.end()),
        rings_of_a_(a.size()),
        boxes_{GridBox(a), GridBox(b)},
        operands_are_simple_(operands_are_simple),
        inside_(inside) {
    rings_.insert(rings_.end(), b.begin(), b.end());
    std::size_t edges = 0;
    for (const Ring* ring : rings_) edges += ring->size();
    edges_.reserve(edges);
    for (std::uint32_t i = 0; i < rings_.size(); ++i) append_near_edges(i);
  }

  std::optional<TracedBorder> trace() {
    if (!find_crossings()) return std::nullopt;
    joints_.resize(points_.size());
    auto begin = passages_.cbegin();
    for (std::uint32_t i = 0; i < rings_.size(); ++i) {
      const auto end = std::find_if(begin, passages_.cend(),
                                    [&](const Passage& passage) { return passage.ring != i; });
      if (begin == end) {
        take_whole(i);
      } else if (!take_stretches(i, {begin, end})) {
        return std::nullopt;
      }
      begin = end;
    }
    if (!join_stretches()) return std::nullopt;
    return TracedBorder{std::move(border_), !points_.empty()};
  }

 private:
  std::uint32_t operand_of(std::uint32_t ring) const { return ring < rings_of_a_ ? 0 : 1; }

  void append_near_edges(std::uint32_t number) {
    const Ring& ring = *rings_[number];
    const GridBox& other = boxes_[1 - operand_of(number)];
    for (std::uint32_t i = 0; i < ring.size(); ++i) {
      const GridEdge edge(ring[i], ring[i + 1 == ring.size() ? 0 : i + 1], number, i);
      if (!operands_are_simple_ || other.meets(edge)) edges_.push_back(edge);
    }
  }

  // False where rings touch.
  bool find_crossings() {
    const auto is_flat = [](const Ring* ring) { return ring->size() < 3; };
    const auto is_point = [](const GridEdge& edge) { return edge.a == edge.b; };
    if (std::any_of(rings_.begin(), rings_.end(), is_flat)) return false;
    if (std::any_of(edges_.begin(), edges_.end(), is_point)) return false;
    bool only_crossings = true;
    visit_near_pairs(edges_, [&](const GridEdge& e, const GridEdge& f) {
      if (operands_are_simple_ && operand_of(e.ring) == operand_of(f.ring)) return true;
      const Meeting how = meeting(e.a, e.b, f.a, f.b);
      if (how == Meeting::kCross) add_crossing(e, f);
      if (how == Meeting::kOverlap || (how == Meeting::kTouch && !are_neighbours(e, f))) {
        only_crossings = false;
      }
      return only_crossings;
    });
    std::sort(passages_.begin(), passages_.end(), [](const Passage& p, const Passage& q) {
      return std::tie(p.ring, p.edge, p.progress) < std::tie(q.ring, q.edge, q.progress);
    });
    return only_crossings;
  }

  bool are_neighbours(const GridEdge& e, const GridEdge& f) const {
    const std::size_t size = rings_[e.ring]->size();
    return e.ring == f.ring && (follows(f, e, size) || follows(e, f, size));
  }

  void add_crossing(const GridEdge& e, const GridEdge& f) {
    const auto turn = static_cast<double>(cross(e.a, e.b, f.a, f.b));
    const double e_progress = static_cast<double>(cross(e.a, f.a, f.a, f.b)) / turn;
    const double f_progress = static_cast<double>(cross(e.a, f.a, e.a, e.b)) / turn;
    const auto crossing = static_cast<std::uint32_t>(points_.size());
    const int e_step = turn > 0.0 ? -1 : 1;
    passages_.push_back({e.ring, e.index, e_progress, crossing, operand_of(f.ring), e_step});
    passages_.push_back({f.ring, f.index, f_progress, crossing, operand_of(e.ring), -e_step});
    points_.push_back(crossing_cell(e.a, e.b, f.a, f.b));
  }

  // Winding numbers on the right of a ring, beside the edge from its smallest vertex: the ring's
  // own is that outside of it, or that of a clockwise corner.
  Windings windings_beside(std::uint32_t number, std::size_t start) const {
    const Ring& ring = *rings_[number];
    const std::uint32_t operand = operand_of(number);
    Windings right{0, 0};
    if (operands_are_simple_ && !boxes_[1 - operand].holds(ring[start])) return right;
    for (std::uint32_t i = 0; i < rings_.size(); ++i) {
      const bool is_known = i == number || (operands_are_simple_ && operand_of(i) == operand);
      if (!is_known) right[operand_of(i)] += winding_number(*rings_[i], ring[start]);
    }
    if (operands_are_simple_) return right;  // the area lies on the left
    const GridPoint before = ring[start == 0 ? ring.size() - 1 : start - 1];
    const GridPoint after = ring[start + 1 == ring.size() ? 0 : start + 1];
    if (orientation(before, ring[start], after) < 0) --right[operand];
    return right;
  }

  // 1 where the area is on the left only, -1 where it is on the right only.
  int side_of_area(std::uint32_t operand, const Windings& right) const {
    Windings left = right;
    ++left[operand];
    return int{inside_(left[0], left[1])} - int{inside_(right[0], right[1])};
  }

  std::size_t smallest_vertex(std::uint32_t number) const {
    const Ring& ring = *rings_[number];
    return static_cast<std::size_t>(std::min_element(ring.begin(), ring.end()) - ring.begin());
  }

  void take_whole(std::uint32_t number) {
    const Windings right = windings_beside(number, smallest_vertex(number));
    const int side = side_of_area(operand_of(number), right);
    if (side == 0) return;
    border_.push_back(*rings_[number]);
    if (side < 0) std::reverse(border_.back().begin(), border_.back().end());
  }

  // False where two stretches of the border leave one crossing, or reach it.
  bool take_stretches(std::uint32_t number, std::span<const Passage> passages) {
    const std::size_t start = smallest_vertex(number);
    Windings right = windings_beside(number, start);
    std::size_t next = 0;
    while (next < passages.size() && passages[next].edge < start) ++next;
    for (std::size_t i = 0; i < passages.size(); ++i) {
      const Passage& first = passages[next == passages.size() ? next = 0 : next];
      const Passage& last = passages[++next == passages.size() ? 0 : next];
      right[first.operand] += first.step;
      const int side = side_of_area(operand_of(number), right);
      if (side == 0) continue;
      const Stretch stretch{&first, &last, side > 0};
      Joint &from = joints_[stretch.start()], &to = joints_[stretch.end()];
      if (from.leaving || to.is_reached) return false;
      from.leaving = stretch;
      to.is_reached = true;
    }
    return true;
  }

  bool join_stretches() {
    const auto is_odd = [](const Joint& joint) {
      return joint.leaving.has_value() != joint.is_reached;
    };
    if (std::any_of(joints_.begin(), joints_.end(), is_odd)) return false;
    for (const Joint& start : joints_) {
      if (!start.leaving) continue;
      Ring ring;
      for (std::uint32_t at = start.leaving->start(); joints_[at].leaving;) {
        const Stretch stretch = *std::exchange(joints_[at].leaving, std::nullopt);
        append(stretch, ring);
        at = stretch.end();
      }
      border_.push_back(std::move(ring));
    }
    return true;
  }

  // The crossing that the stretch starts in, and the vertices on its way.
  void append(const Stretch& stretch, Ring& result) const {
    const Passage &first = *stretch.first, &last = *stretch.last;
    result.push_back(points_[stretch.start()]);
    if (first.edge == last.edge && &first < &last) return;
    const Ring& ring = *rings_[first.ring];
    const auto old_size = static_cast<std::ptrdiff_t>(result.size());
    std::size_t vertex = first.edge;
    do {
      vertex = vertex + 1 == ring.size() ? 0 : vertex + 1;
      result.push_back(ring[vertex]);
    } while (vertex != last.edge);
    if (!stretch.is_forward) std::reverse(result.begin() + old_size, result.end());
  }

  std::vector<const Ring*> rings_;  // of a, then of b
  std::size_t rings_of_a_;
  std::array<GridBox, 2> boxes_;  // of the operands
  bool operands_are_simple_;
  InsideRule inside_;
  std::vector<GridEdge> edges_;    // those that may cross another
  std::vector<GridPoint> points_;  // of the crossings
  std::vector<Passage> passages_;  // two for each crossing, in the order of their rings
  std::vector<Joint> joints_;      // one for each crossing
  std::vector<Ring> border_;
};

}  // namespace

std::optional<TracedBorder> trace_overlay(const Polygon& a, const Polygon& b, InsideRule inside) {
  return Tracer(rings_of(a), rings_of(b), true, inside).trace();
}

std::optional<TracedBorder> trace_overlay(std::span<const Ring> rings, InsideRule inside) {
  std::vector<const Ring*> pointers;
  for (const Ring& ring : rings) pointers.push_back(&ring);
  return Tracer(pointers, {}, false, inside).trace();
}

}  // namespace geomap::geometry
