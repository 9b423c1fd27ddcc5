// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/outline_collapse.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "geometry/grid_predicates.hpp"
#include "geometry/ring_contacts.hpp"

namespace geomap::geometry {
namespace {

using Eigen::Vector2d;

constexpr double kNever = std::numeric_limits<double>::infinity();  // error of no step at all

Vector2d between(GridPoint from, GridPoint to) {
  return {static_cast<double>(dx(from, to)), static_cast<double>(dy(from, to))};
}

double squared_distance(GridPoint p, GridPoint a, GridPoint b) {
  const Vector2d along = between(a, b), to_p = between(a, p);
  const double t = std::clamp(along.dot(to_p) / along.squaredNorm(), 0.0, 1.0);
  return (to_p - t * along).squaredNorm();
}

double squared_distance(GridPoint p, std::span<const GridPoint> path) {
  double least = kNever;
  for (std::size_t i = 1; i < path.size(); ++i) {
    least = std::min(least, squared_distance(p, path[i - 1], path[i]));
  }
  return least;
}

// The point E for which the path A-E-D bounds the same area as A-B-C-D: on the line parallel to AD
// at the right height, where it meets AB or CD, whichever moves the path less.
std::optional<GridPoint> area_preserving_point(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
  const Vector2d ab = between(a, b), ac = between(a, c), ad = between(a, d);
  const auto cross_of = [](const Vector2d& p, const Vector2d& q) {
    return p.x() * q.y() - p.y() * q.x();
  };
  const double b_height = cross_of(ad, ab), c_height = cross_of(ad, ac);  // times |AD|
  const double height = c_height - cross_of(ab, ac);
  const bool same_side = (b_height > 0.0) == (c_height > 0.0);
  const bool on_ab =
      same_side ? std::abs(b_height) > std::abs(c_height) : (height > 0.0) == (b_height > 0.0);
  const double reach = on_ab ? b_height : c_height;
  if (reach == 0.0) return b;
  const double share = height / reach;
  const Vector2d e = on_ab ? Vector2d(share * ab) : Vector2d(ad + share * (ac - ad));
  // Far away (AB and CD nearly parallel to AD): no use, and perhaps not on the grid.
  if (!(e.norm() <= 2.0 * (ab.norm() + ac.norm() + ad.norm()))) return std::nullopt;
  const double x = std::floor(a.x + e.x() + 0.5), y = std::floor(a.y + e.y() + 0.5);
  constexpr double kLargest = std::numeric_limits<std::int32_t>::max();
  if (std::abs(x) > kLargest || std::abs(y) > kLargest) return std::nullopt;
  return GridPoint{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)};
}

// Two edges from a common vertex that leave it in the same direction.
bool fold_up(GridPoint at, GridPoint p, GridPoint q) {
  return orientation(p, at, q) == 0 && dot(at, p, at, q) > 0;
}

}  // namespace

OutlineCollapse::OutlineCollapse(std::vector<Ring> rings, double tolerance,
                                 const std::function<bool(GridPoint)>& is_fixed)
    : originals_(std::move(rings)), squared_tolerance_(tolerance * tolerance) {
  for (Index r = 0; r < originals_.size(); ++r) {
    const Ring& ring = originals_[r];
    const auto base = static_cast<Index>(nodes_.size()), size = static_cast<Index>(ring.size());
    for (Index i = 0; i < size; ++i) {
      nodes_.push_back({ring[i], base + (i == 0 ? size - 1 : i - 1),
                        base + (i + 1 == size ? 0 : i + 1), r, i, is_fixed && is_fixed(ring[i]),
                        true});
    }
    counts_.push_back(size);
  }
  steps_.resize(nodes_.size());
  errors_.resize(nodes_.size(), kNever);
  listed_.resize(nodes_.size());
  std::iota(listed_.begin(), listed_.end(), 0U);
}

void OutlineCollapse::run() {
  if (nodes_.empty()) return;
  for (Index i = 0; i < nodes_.size(); ++i) refresh(i);
  for (;;) {
    const Index best = *std::min_element(listed_.begin(), listed_.end(),
                                         [&](Index i, Index j) { return errors_[i] < errors_[j]; });
    if (!steps_[best]) return;
    const Step step = *steps_[best];
    if (vertices_after(step) >= 3 && within_tolerance(step) && keeps_topology(step)) {
      apply(step);
    } else {
      forget(best);
    }
  }
}

std::vector<Ring> OutlineCollapse::rings() const {
  std::vector<Ring> result(originals_.size());
  std::vector<bool> done(originals_.size(), false);
  for (Index start = 0; start < nodes_.size(); ++start) {
    const Index ring = nodes_[start].ring;
    if (!nodes_[start].alive || done[ring]) continue;
    Index i = start;
    do {
      result[ring].push_back(nodes_[i].point);
      i = nodes_[i].next;
    } while (i != start);
    done[ring] = true;
  }
  return result;
}

std::optional<OutlineCollapse::Step> OutlineCollapse::step_at(Index first) const {
  const Node& b = nodes_[first];
  const Node& c = nodes_[b.next];
  if (!b.alive || counts_[b.ring] < 4 || (b.fixed && c.fixed)) return std::nullopt;
  Step step = b.fixed ? removal(b.next) : c.fixed ? removal(first) : collapse(first, b.next);
  if (!(step.squared_error <= squared_tolerance_)) return std::nullopt;
  return step;
}

OutlineCollapse::Step OutlineCollapse::removal(Index b) const {
  const Node& node = nodes_[b];
  const double error =
      squared_distance(node.point, nodes_[node.prev].point, nodes_[node.next].point);
  return {node.prev, node.next, std::nullopt, error};
}

OutlineCollapse::Step OutlineCollapse::collapse(Index b, Index c) const {
  Step step{nodes_[b].prev, nodes_[c].next, std::nullopt, 0.0};
  const GridPoint old_path[] = {nodes_[step.from].point, nodes_[b].point, nodes_[c].point,
                                nodes_[step.to].point};
  step.middle = area_preserving_point(old_path[0], old_path[1], old_path[2], old_path[3]);
  if (!step.middle) {
    step.squared_error = kNever;
    return step;
  }
  const GridPoint new_path[] = {old_path[0], *step.middle, old_path[3]};
  if (orientation(new_path[0], new_path[1], new_path[2]) == 0) step.middle.reset();
  const GridPoint straight[] = {old_path[0], old_path[3]};
  const std::span<const GridPoint> path =
      step.middle ? std::span<const GridPoint>(new_path) : std::span<const GridPoint>(straight);
  step.squared_error =
      std::max(squared_distance(old_path[1], path), squared_distance(old_path[2], path));
  if (step.middle) {
    step.squared_error = std::max(step.squared_error, squared_distance(*step.middle, old_path));
  }
  return step;
}

void OutlineCollapse::refresh(Index first) {
  steps_[first] = step_at(first);
  errors_[first] = steps_[first] ? steps_[first]->squared_error : kNever;
}

void OutlineCollapse::forget(Index first) {
  steps_[first].reset();
  errors_[first] = kNever;
}

OutlineCollapse::Index OutlineCollapse::vertices_after(const Step& step) const {
  const Index replaced = nodes_[nodes_[step.from].next].next == step.to ? 1 : 2;
  return counts_[nodes_[step.from].ring] + (step.middle ? 1 : 0) - replaced;
}

// The originals near the step against the new path with one more edge at either end, where their
// nearest edge may have been, and the new vertex against the originals that it replaces.
bool OutlineCollapse::within_tolerance(const Step& step) const {
  const Node &from = nodes_[step.from], &to = nodes_[step.to];
  const Ring& ring = originals_[from.ring];
  const auto size = static_cast<Index>(ring.size());
  Ring path{nodes_[from.prev].point, from.point};
  if (step.middle) path.push_back(*step.middle);
  path.push_back(to.point);
  path.push_back(nodes_[to.next].point);

  const bool is_whole_ring = vertices_after(step) < path.size();
  const Index first = is_whole_ring ? 0 : (nodes_[from.prev].anchor + 1) % size;
  const Index end = is_whole_ring ? size : nodes_[to.next].anchor;
  const Index count = is_whole_ring ? size : (end + size - first) % size;
  for (Index k = 0; k < count; ++k) {
    if (squared_distance(ring[(first + k) % size], path) > squared_tolerance_) return false;
  }
  if (!step.middle) return true;
  for (Index i = from.anchor; i != to.anchor; i = (i + 1) % size) {
    if (squared_distance(*step.middle, ring[i], ring[(i + 1) % size]) <= squared_tolerance_) {
      return true;
    }
  }
  return false;
}

// Nothing may touch the new edges, and nothing may lie between the old path and the new one.
bool OutlineCollapse::keeps_topology(const Step& step) const {
  Change change;
  change.new_path.push_back(nodes_[step.from].point);
  if (step.middle) change.new_path.push_back(*step.middle);
  change.new_path.push_back(nodes_[step.to].point);
  for (Index i = step.from; i != step.to; i = nodes_[i].next) {
    change.swept.push_back(nodes_[i].point);
  }
  change.swept.insert(change.swept.end(), change.new_path.rbegin(), change.new_path.rend() - 1);
  change.lower = change.upper = change.swept[0];
  for (const GridPoint p : change.swept) {
    change.lower = {std::min(change.lower.x, p.x), std::min(change.lower.y, p.y)};
    change.upper = {std::max(change.upper.x, p.x), std::max(change.upper.y, p.y)};
  }
  if (step.middle && fold_up(*step.middle, change.new_path.front(), change.new_path.back())) {
    return false;
  }
  return std::none_of(listed_.begin(), listed_.end(),
                      [&](Index p) { return nodes_[p].alive && obstructs(p, step, change); });
}

// Whether vertex p, or the edge that starts there, is in the way.
bool OutlineCollapse::obstructs(Index p, const Step& step, const Change& change) const {
  const Node& node = nodes_[p];
  const GridPoint a = node.point, b = nodes_[node.next].point;
  if (std::max(a.x, b.x) < change.lower.x || std::min(a.x, b.x) > change.upper.x ||
      std::max(a.y, b.y) < change.lower.y || std::min(a.y, b.y) > change.upper.y) {
    return false;
  }
  const Index inner = nodes_[step.from].next;
  const bool is_replaced =
      p == step.from || p == inner || (node.next == step.to && node.prev == inner);
  if (is_replaced) return false;
  if (p != step.to && locate(a, change.swept) != Side::kOutside) return true;
  const Ring& path = change.new_path;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const bool follows = p == step.to && i + 1 == path.size();
    const bool precedes = node.next == step.from && i == 1;
    if (follows && fold_up(a, path[i - 1], b)) return true;
    if (precedes && fold_up(b, path[i], a)) return true;
    if (follows || precedes) continue;
    if (meeting(path[i - 1], path[i], a, b) != Meeting::kApart) return true;
  }
  return false;
}

OutlineCollapse::Index OutlineCollapse::nearest_original(const Step& step) const {
  const Node &from = nodes_[step.from], &to = nodes_[step.to];
  const Ring& ring = originals_[from.ring];
  const auto size = static_cast<Index>(ring.size());
  Index nearest = (from.anchor + 1) % size;
  double least = kNever;
  for (Index i = nearest; i != to.anchor; i = (i + 1) % size) {
    const double distance = between(ring[i], *step.middle).squaredNorm();
    if (distance < least) {
      least = distance;
      nearest = i;
    }
  }
  return nearest;
}

void OutlineCollapse::apply(const Step& step) {
  counts_[nodes_[step.from].ring] = vertices_after(step);
  const Index inner = nodes_[step.from].next;
  const Index anchor = step.middle ? nearest_original(step) : 0;
  for (Index i = inner; i != step.to; i = nodes_[i].next) {
    nodes_[i].alive = false;
    forget(i);
  }
  Index before_to = step.from;
  if (step.middle) {
    Node& middle = nodes_[inner];
    middle = {*step.middle, step.from, step.to, middle.ring, anchor, false, true};
    before_to = inner;
  }
  nodes_[step.from].next = step.middle ? inner : step.to;
  nodes_[step.to].prev = before_to;
  refresh(nodes_[step.from].prev);
  refresh(step.from);
  refresh(before_to);
  refresh(step.to);
  if (++steps_since_listing_ > listed_.size() / 8) {
    std::erase_if(listed_, [&](Index i) { return !nodes_[i].alive; });
    steps_since_listing_ = 0;
  }
}

}  // namespace geomap::geometry
