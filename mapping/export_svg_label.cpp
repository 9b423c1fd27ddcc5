// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/export_svg_label.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

namespace geomap::mapping {
namespace {

constexpr int kRaster = 9;            // spots per direction, beside the roomiest one
constexpr double kAmple = 26.0;       // clearance beyond which nearness to the middle counts [px]
constexpr double kPrecision = 1.0;    // of the largest clearance [px]
constexpr int kLargestSearch = 2000;  // cells; bounds the time on needle-thin shapes

double distance_to_edge(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                        const Eigen::Vector2d& b) {
  const Eigen::Vector2d edge = b - a;
  const double length2 = edge.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((p - a).dot(edge) / length2, 0.0, 1.0) : 0.0;
  return (p - a - t * edge).norm();
}

struct Cell {
  LabelSpot spot;
  double half = 0.0;  // of the cell's side
  double best() const { return spot.clearance + half * std::numbers::sqrt2; }
  bool operator<(const Cell& other) const { return best() < other.best(); }
};

// Pole of inaccessibility: a quadtree, the most promising cell first (the method of
// mapbox/polylabel).
LabelSpot roomiest_spot(const PictureRings& rings, const Eigen::AlignedBox2d& box) {
  const auto cell_at = [&](const Eigen::Vector2d& p, double half) {
    return Cell{{p, clearance(rings, p)}, half};
  };
  std::priority_queue<Cell> cells;
  cells.push(cell_at(box.center(), box.sizes().maxCoeff() / 2.0));
  LabelSpot roomiest = cells.top().spot;
  for (int i = 0; i < kLargestSearch && !cells.empty(); ++i) {
    const Cell cell = cells.top();
    cells.pop();
    if (cell.best() <= roomiest.clearance + kPrecision) break;
    const double half = cell.half / 2.0;
    for (const Eigen::Vector2d& side :
         {Eigen::Vector2d(-half, -half), Eigen::Vector2d(half, -half), Eigen::Vector2d(-half, half),
          Eigen::Vector2d(half, half)}) {
      const Cell child = cell_at(cell.spot.point + side, half);
      if (child.spot.clearance > roomiest.clearance) roomiest = child.spot;
      cells.push(child);
    }
  }
  return roomiest;
}

}  // namespace

double clearance(const PictureRings& rings, const Eigen::Vector2d& point) {
  double nearest = std::numeric_limits<double>::max();
  bool inside = false;
  for (const auto& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d& a = ring[i];
      const Eigen::Vector2d& b = ring[(i + 1) % ring.size()];
      nearest = std::min(nearest, distance_to_edge(point, a, b));
      if ((a.y() > point.y()) == (b.y() > point.y())) continue;
      const double crossing = a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
      if (point.x() < crossing) inside = !inside;
    }
  }
  return inside ? nearest : -nearest;
}

std::vector<LabelSpot> label_spots(const PictureRings& rings) {
  Eigen::AlignedBox2d box;
  for (const auto& ring : rings) {
    for (const Eigen::Vector2d& vertex : ring) box.extend(vertex);
  }
  std::vector<LabelSpot> spots;
  if (box.isEmpty()) return spots;
  spots.push_back(roomiest_spot(rings, box));
  for (int row = 0; row < kRaster; ++row) {
    for (int column = 0; column < kRaster; ++column) {
      const Eigen::Array2d part((column + 0.5) / kRaster, (row + 0.5) / kRaster);
      const Eigen::Vector2d point = box.min().array() + part * box.sizes().array();
      spots.push_back({point, clearance(rings, point)});
    }
  }
  std::erase_if(spots, [](const LabelSpot& spot) { return spot.clearance <= 0.0; });
  const auto rank = [&](const LabelSpot& spot) {
    return std::pair(-std::min(spot.clearance, kAmple), (spot.point - box.center()).norm());
  };
  std::stable_sort(spots.begin(), spots.end(),
                   [&](const LabelSpot& a, const LabelSpot& b) { return rank(a) < rank(b); });
  return spots;
}

}  // namespace geomap::mapping
