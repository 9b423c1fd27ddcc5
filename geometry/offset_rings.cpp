// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/offset_rings.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/ring_contacts.hpp"

namespace geomap::geometry {
namespace {

using Eigen::Vector2d;

struct Edge {
  Edge(GridPoint from, GridPoint to)
      : outward(static_cast<double>(to.y) - from.y, static_cast<double>(from.x) - to.x),
        length(outward.norm()) {
    outward /= length;
  }
  Vector2d outward;  // normal
  double length;     // [grid unit]
};

// The ring of the moved edges, corner by corner.
class OffsetRing {
 public:
  explicit OffsetRing(double distance) : distance_(distance) {}

  void add_corner(GridPoint corner, const Edge& edge_before, const Edge& edge_after) {
    const Vector2d &before = edge_before.outward, &after = edge_after.outward;
    const double sine = before.x() * after.y() - before.y() * after.x();
    const double cosine = before.dot(after);
    const double lengthening = distance_ * sine / (1.0 + cosine);  // of both edges, by a mitre
    const bool is_shorter = lengthening < 0.0;
    // An edge of which both corners leave half does not turn round.
    const bool leaves_half = -2.0 * lengthening <= std::min(edge_before.length, edge_after.length);
    if (std::abs(sine * distance_) < 1.0 && cosine > 0.0) {  // straight to within a grid unit
      add(corner, distance_ * before);
    } else if (is_shorter ? leaves_half : 1.0 + cosine >= 2.0 / (kMitreLimit * kMitreLimit)) {
      add(corner, distance_ / (1.0 + cosine) * (before + after));
    } else if (is_shorter) {  // by way of the corner, so that all that the loop encloses is inside
      add(corner, distance_ * before);
      add(corner, Vector2d::Zero());
      add(corner, distance_ * after);
    } else {  // cut off at the distance
      const double along = std::tan(std::atan2(sine, cosine) / 4.0);
      add(corner, distance_ * (before + along * Vector2d(-before.y(), before.x())));
      add(corner, distance_ * (after - along * Vector2d(-after.y(), after.x())));
    }
  }

  Ring take() && {
    if (ring_.size() > 1 && ring_.front() == ring_.back()) ring_.pop_back();
    return std::move(ring_);
  }

 private:
  void add(GridPoint corner, const Vector2d& move) {
    const Vector2d moved = Vector2d(corner.x, corner.y) + move;
    const GridPoint point{static_cast<std::int32_t>(std::floor(moved.x() + 0.5)),
                          static_cast<std::int32_t>(std::floor(moved.y() + 0.5))};
    if (ring_.empty() || ring_.back() != point) ring_.push_back(point);
  }

  double distance_;
  Ring ring_;
};

}  // namespace

std::vector<Ring> offset_rings(const Polygon& polygon, double distance) {
  std::vector<Ring> result;
  for (const Ring* ring : rings_of(polygon)) {
    OffsetRing moved(distance);
    Edge before(ring->back(), ring->front());
    for (std::size_t i = 0; i < ring->size(); ++i) {
      const GridPoint corner = (*ring)[i];
      const Edge after(corner, (*ring)[i + 1 == ring->size() ? 0 : i + 1]);
      moved.add_corner(corner, before, after);
      before = after;
    }
    result.push_back(std::move(moved).take());
  }
  return result;
}

}  // namespace geomap::geometry
