// SPDX-License-Identifier: BSD-3-Clause
#include "perception/plane_parts.hpp"

#include <algorithm>
#include <numeric>

#include "perception/plane_rays.hpp"

namespace geomap::perception {
namespace {

constexpr int kNearestPixels = 6;  // gaps up to this never separate [pixel]

// Disjoint sets of a plane's cells; the representative is the first one.
class Groups {
 public:
  explicit Groups(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    if (parent_[a] == parent_[b]) return;
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

// Pixels between two boxes, along the axis in which they are farther apart.
int gap_between(const Eigen::AlignedBox2i& a, const Eigen::AlignedBox2i& b) {
  const Eigen::Vector2i gap = (b.min() - a.max()).cwiseMax(a.min() - b.max());
  return gap.maxCoeff() - 1;
}

// The widest gap at a cell that does not separate [pixel].
int gap_in_pixels(const geometry::CameraModel& camera, const geometry::Plane& plane,
                  const PlaneCell& cell, double gap) {
  const Eigen::Vector2d at = cell.box.cast<double>().center();
  return meets(camera, plane, at) ? static_cast<int>(gap / pixel_length(camera, plane, at)) : 0;
}

}  // namespace

std::vector<PlanePart> split_into_parts(const geometry::CameraModel& camera, int columns,
                                        const geometry::Plane& plane,
                                        const std::vector<PlaneCell>& cells, double gap,
                                        int least_pixels) {
  // Each cell is joined with the next one in its row, the next one in its column, and those
  // touching its lower corners: `last` is the latest cell seen in each column, by index into cells.
  constexpr int kNone = -1;
  static_assert(2 * (DepthCells::kSide - 1) <= kNearestPixels);  // cells that touch are one part
  Groups groups(cells.size());
  std::vector<int> last(static_cast<std::size_t>(columns), kNone);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const int column = cells[i].box.min().x() / DepthCells::kSide;
    const auto join_if_near = [&](std::size_t other) {
      const int pixels = gap_between(cells[other].box, cells[i].box);
      if (pixels <= kNearestPixels || pixels <= gap_in_pixels(camera, plane, cells[i], gap)) {
        groups.join(other, i);
      }
    };
    if (i > 0 && cells[i].cell - cells[i - 1].cell <= column) join_if_near(i - 1);
    int& above = last[static_cast<std::size_t>(column)];
    if (above != kNone && cells[static_cast<std::size_t>(above)].cell + columns == cells[i].cell) {
      groups.join(static_cast<std::size_t>(above), i);  // and so those that touch both
    } else {
      for (int c = std::max(0, column - 1); c <= std::min(columns - 1, column + 1); ++c) {
        const int other = last[static_cast<std::size_t>(c)];
        if (other != kNone) join_if_near(static_cast<std::size_t>(other));
      }
    }
    above = static_cast<int>(i);
  }

  std::vector<PlanePart> parts;
  std::vector<std::size_t> part_of(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::size_t first = groups.find(i);
    if (first == i) {
      part_of[i] = parts.size();
      parts.emplace_back();
    }
    parts[part_of[first]].push_back(&cells[i]);
  }
  std::erase_if(parts, [least_pixels](const PlanePart& part) {
    int pixels = 0;
    for (const PlaneCell* cell : part) pixels += cell->pixels;
    return pixels < least_pixels;
  });
  return parts;
}

}  // namespace geomap::perception
