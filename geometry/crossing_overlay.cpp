// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/crossing_overlay.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <tuple>

#include "geometry/edge_sweep.hpp"
#include "geometry/grid_predicates.hpp"
#include "geometry/ring_contacts.hpp"

namespace geomap::geometry {
namespace {

// Where a ring passes through a crossing.
struct Passage {
  std::uint32_t ring, edge;
  double progress;  // along the edge, 0 to 1; as long as it errs, alternation tells
  std::size_t crossing;
  bool enters;  // the other operand's area
};

struct GridBox {
  explicit GridBox(const std::vector<Ring>& rings) {
    for (const Ring& ring : rings) {
      for (const GridPoint p : ring) {
        lower = {std::min(lower.x, p.x), std::min(lower.y, p.y)};
        upper = {std::max(upper.x, p.x), std::max(upper.y, p.y)};
      }
    }
  }
  bool meets(const GridEdge& edge) const {
    return edge.min_x <= upper.x && edge.max_x >= lower.x && edge.min_y <= upper.y &&
           edge.max_y >= lower.y;
  }

  static constexpr std::int32_t kLargest = std::numeric_limits<std::int32_t>::max();
  GridPoint lower{kLargest, kLargest}, upper{-kLargest, -kLargest};
};

// The operand's rings with its area on their left.
std::vector<Ring> directed_rings(const Operand& operand) {
  std::vector<Ring> rings;
  for (const Ring* ring : rings_of(operand.polygon)) {
    rings.push_back(*ring);
    if (operand.is_complement) std::reverse(rings.back().begin(), rings.back().end());
  }
  return rings;
}

// For a point that is not on the border.
bool covers(const Operand& operand, GridPoint point) {
  bool inside = operand.is_complement;
  for (const Ring* ring : rings_of(operand.polygon)) {
    if (locate(point, *ring) == Side::kInside) inside = !inside;
  }
  return inside;
}

class Tracer {
 public:
  Tracer(const Operand& a, const Operand& b)
      : operands_{&a, &b}, rings_(directed_rings(a)), rings_of_a_(rings_.size()) {
    std::vector<Ring> of_b = directed_rings(b);
    const GridBox box_of_a(rings_), box_of_b(of_b);
    std::move(of_b.begin(), of_b.end(), std::back_inserter(rings_));
    for (std::uint32_t i = 0; i < rings_.size(); ++i) {
      append_near_edges(i, i < rings_of_a_ ? box_of_b : box_of_a);
    }
  }

  std::optional<std::vector<Ring>> trace() {
    if (!find_crossings() || !enter_and_leave_in_turn()) return std::nullopt;
    std::vector<Ring> result = uncrossed_rings();
    follow_crossed_rings(result);
    return result;
  }

 private:
  void append_near_edges(std::uint32_t number, const GridBox& box) {
    const Ring& ring = rings_[number];
    for (std::uint32_t i = 0; i < ring.size(); ++i) {
      const GridEdge edge(ring[i], ring[i + 1 == ring.size() ? 0 : i + 1], number, i);
      if (box.meets(edge)) edges_.push_back(edge);
    }
  }

  bool is_of_a(const GridEdge& edge) const { return edge.ring < rings_of_a_; }

  // False where the borders touch.
  bool find_crossings() {
    bool only_crossings = true;
    visit_near_pairs(edges_, [&](const GridEdge& e, const GridEdge& f) {
      if (is_of_a(e) == is_of_a(f)) return true;
      const Meeting how = meeting(e.a, e.b, f.a, f.b);
      if (how == Meeting::kCross) add_crossing(e, f);
      only_crossings = how == Meeting::kCross || how == Meeting::kApart;
      return only_crossings;
    });
    std::sort(passages_.begin(), passages_.end(), [](const Passage& p, const Passage& q) {
      return std::tie(p.ring, p.edge, p.progress) < std::tie(q.ring, q.edge, q.progress);
    });
    return only_crossings;
  }

  void add_crossing(const GridEdge& e, const GridEdge& f) {
    const auto turn = static_cast<double>(cross(e.a, e.b, f.a, f.b));
    const double e_progress = static_cast<double>(cross(e.a, f.a, f.a, f.b)) / turn;
    const double f_progress = static_cast<double>(cross(e.a, f.a, e.a, e.b)) / turn;
    passages_.push_back({e.ring, e.index, e_progress, points_.size(), turn < 0.0});
    passages_.push_back({f.ring, f.index, f_progress, points_.size(), turn > 0.0});
    points_.push_back(crossing_cell(e.a, e.b, f.a, f.b));
  }

  const Passage& after(const Passage& passage) const {
    const std::size_t next = static_cast<std::size_t>(&passage - passages_.data()) + 1;
    if (next < passages_.size() && passages_[next].ring == passage.ring) return passages_[next];
    return *std::lower_bound(
        passages_.begin(), passages_.end(), passage.ring,
        [](const Passage& other, std::uint32_t ring) { return other.ring < ring; });
  }

  bool enter_and_leave_in_turn() const {
    return std::all_of(passages_.begin(), passages_.end(), [&](const Passage& passage) {
      return passage.enters != after(passage).enters;
    });
  }

  // Those that lie in the other area as a whole.
  std::vector<Ring> uncrossed_rings() const {
    std::vector<bool> is_crossed(rings_.size(), false);
    for (const Passage& passage : passages_) is_crossed[passage.ring] = true;
    std::vector<Ring> result;
    for (std::size_t i = 0; i < rings_.size(); ++i) {
      const Operand& other = *operands_[i < rings_of_a_ ? 1 : 0];
      if (!is_crossed[i] && covers(other, rings_[i][0])) result.push_back(rings_[i]);
    }
    return result;
  }

  // Exactly one of the two rings enters at a crossing; where it leaves again the other one enters.
  void follow_crossed_rings(std::vector<Ring>& result) const {
    std::vector<const Passage*> entering(points_.size());
    for (const Passage& passage : passages_) {
      if (passage.enters) entering[passage.crossing] = &passage;
    }
    for (const Passage*& start : entering) {
      Ring ring;
      for (const Passage** at = &start; *at != nullptr;) {
        const Passage& from = **at;
        const Passage& to = after(from);
        append_stretch(from, to, ring);
        *at = nullptr;
        at = &entering[to.crossing];
      }
      if (!ring.empty()) result.push_back(std::move(ring));
    }
  }

  // The crossing `from` and the vertices between it and `to` on their ring.
  void append_stretch(const Passage& from, const Passage& to, Ring& result) const {
    result.push_back(points_[from.crossing]);
    if (from.edge == to.edge && from.progress < to.progress) return;
    const Ring& ring = rings_[from.ring];
    std::size_t vertex = from.edge;
    do {
      vertex = vertex + 1 == ring.size() ? 0 : vertex + 1;
      result.push_back(ring[vertex]);
    } while (vertex != to.edge);
  }

  std::array<const Operand*, 2> operands_;
  std::vector<Ring> rings_;  // of a, then of b
  std::size_t rings_of_a_;
  std::vector<GridEdge> edges_;    // those near the other operand
  std::vector<GridPoint> points_;  // of the crossings
  std::vector<Passage> passages_;  // two for each crossing, in the order of their rings
};

}  // namespace

std::optional<std::vector<Ring>> trace_intersection(const Operand& a, const Operand& b) {
  return Tracer(a, b).trace();
}

}  // namespace geomap::geometry
