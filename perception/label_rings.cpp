// SPDX-License-Identifier: BSD-3-Clause
#include "perception/label_rings.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "geometry/multiversion.hpp"

namespace geomap::perception {
namespace {

// Where a border runs along the upper edge of a row's pixels.
GEOMAP_MULTIVERSION void find_tops(const std::int16_t* __restrict row,
                                   const std::int16_t* __restrict above, int width,
                                   std::uint8_t* __restrict is_top) {
  for (int x = 0; x < width; ++x) {
    is_top[x] = static_cast<std::uint8_t>(static_cast<int>(row[x] >= 0) &
                                          static_cast<int>(row[x] != above[x]));
  }
}

class Tracer {
 public:
  Tracer(const std::vector<std::int16_t>& label, int width, int height)
      : label_(label),
        width_(width),
        height_(height),
        walked_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0) {}

  std::vector<LabelRing> all() {
    std::vector<LabelRing> rings;
    const std::vector<std::int16_t> outside(static_cast<std::size_t>(width_), -1);
    std::vector<std::uint8_t> is_top(static_cast<std::size_t>(width_));
    for (int y = 0; y < height_; ++y) {
      const std::int16_t* row = label_.data() + index(0, y);
      const std::int16_t* above = y > 0 ? row - width_ : outside.data();
      find_tops(row, above, width_, is_top.data());
      for (auto top = is_top.begin();
           (top = std::find(top, is_top.end(), std::uint8_t{1})) != is_top.end(); ++top) {
        const int x = static_cast<int>(top - is_top.begin());
        if (walked_[index(x, y)] == 0) rings.push_back(walk(x, y, label_[index(x, y)]));
      }
    }
    return rings;
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }
  bool is(int x, int y, std::int16_t label) const {
    return x >= 0 && y >= 0 && x < width_ && y < height_ && label_[index(x, y)] == label;
  }

  // From the upper edge of a pixel eastwards, until that edge comes again.
  LabelRing walk(int x0, int y0, std::int16_t label) {
    // East, south, west, north: the step, and the pixels ahead on the right and on the left.
    constexpr std::array<std::array<int, 2>, 4> kStep = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    constexpr std::array<std::array<int, 2>, 4> kRight = {{{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}};
    constexpr std::array<std::array<int, 2>, 4> kLeft = {{{0, -1}, {0, 0}, {-1, 0}, {-1, -1}}};
    LabelRing ring;
    ring.label = label;
    int x = x0, y = y0;
    std::size_t heading = 0;
    do {
      if (heading == 0) walked_[index(x, y)] = 1;
      x += kStep[heading][0];
      y += kStep[heading][1];
      if (heading == 1) ring.area += x;
      if (heading == 3) ring.area -= x;
      std::size_t next = heading;
      if (!is(x + kRight[heading][0], y + kRight[heading][1], label)) {
        next = (heading + 1) % 4;
      } else if (is(x + kLeft[heading][0], y + kLeft[heading][1], label)) {
        next = (heading + 3) % 4;
      }
      if (next != heading) ring.corners.push_back({x, y});
      heading = next;
    } while (x != x0 || y != y0 || heading != 0);
    return ring;
  }

  const std::vector<std::int16_t>& label_;
  int width_, height_;
  std::vector<std::uint8_t> walked_;  // the upper edge of a pixel
};

// Squared distance of p from the stretch between a and b.
double squared_distance(PixelCorner p, PixelCorner a, PixelCorner b) {
  const double dx = b.x - a.x, dy = b.y - a.y, px = p.x - a.x, py = p.y - a.y;
  const double length = dx * dx + dy * dy, along = px * dx + py * dy;
  if (!(along > 0.0)) return px * px + py * py;
  if (along >= length) return (p.x - b.x) * (p.x - b.x) + (p.y - b.y) * (p.y - b.y);
  const double across = px * dy - py * dx;
  return across * across / length;
}

}  // namespace

std::vector<LabelRing> trace_labels(const std::vector<std::int16_t>& label, int width, int height) {
  return Tracer(label, width, height).all();
}

std::vector<PixelCorner> simplify_ring(const std::vector<PixelCorner>& ring, double tolerance) {
  const std::size_t size = ring.size();
  if (size < 4) return ring;
  const auto at = [&ring, size](std::size_t i) { return ring[i % size]; };
  std::size_t far = 0;
  std::int64_t farthest = -1;
  for (std::size_t i = 0; i < size; ++i) {
    const std::int64_t dx = ring[i].x - ring[0].x, dy = ring[i].y - ring[0].y;
    if (dx * dx + dy * dy > farthest) {
      farthest = dx * dx + dy * dy;
      far = i;
    }
  }
  std::vector<std::uint8_t> kept(size, 0);
  kept[0] = kept[far] = 1;
  std::vector<std::pair<std::size_t, std::size_t>> open = {{0, far}, {far, size}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    double largest = tolerance * tolerance;
    std::size_t worst = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double squared = squared_distance(at(i), at(first), at(last));
      if (squared <= largest) continue;
      largest = squared;
      worst = i;
    }
    if (worst == first) continue;
    kept[worst] = 1;
    open.emplace_back(first, worst);
    open.emplace_back(worst, last);
  }
  std::vector<PixelCorner> result;
  for (std::size_t i = 0; i < size; ++i) {
    if (kept[i] != 0) result.push_back(ring[i]);
  }
  return result;
}

}  // namespace geomap::perception
