// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/outline_code.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace geomap::mapping {
namespace {

using geometry::GridPoint;
using geometry::Polygon;
using geometry::PolygonPart;
using geometry::Ring;

constexpr std::int64_t kFarthest = 10'000'000;  // coordinate [0.1 mm]
constexpr std::uint64_t kMostVertices = 20'000;
constexpr std::uint64_t kMostRings = kMostVertices / 3;
constexpr std::size_t kLeastCopied = 2;  // vertices; a single one is as short in itself

class Writer {
 public:
  explicit Writer(const Polygon& before) : known_(geometry::vertices(before)) {
    for (std::size_t i = 0; i < known_.size(); ++i) place_.emplace(known_[i], i);
  }

  void number(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) {
      bytes_.push_back(static_cast<std::uint8_t>(value | 0x80));
    }
    bytes_.push_back(static_cast<std::uint8_t>(value));
  }

  void ring(const Ring& ring) {
    number(ring.size());
    std::size_t written = 0;
    for (std::size_t i = 0; i < ring.size();) {
      const auto [from, count] = find_known(ring, i);
      if (count < kLeastCopied) {
        ++i;
        continue;
      }
      new_run(ring, written, i);
      known_run(from, count);
      written = i += count;
    }
    new_run(ring, written, ring.size());
  }

  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  // Where the ring's vertices from `at` on are known from, and how many of them.
  std::pair<std::size_t, std::size_t> find_known(const Ring& ring, std::size_t at) const {
    const auto found = place_.find(ring[at]);
    if (found == place_.end()) return {0, 0};
    const auto known = known_.begin() + static_cast<std::ptrdiff_t>(found->second);
    const auto start = ring.begin() + static_cast<std::ptrdiff_t>(at);
    const auto end = std::mismatch(start, ring.end(), known, known_.end()).first;
    return {found->second, static_cast<std::size_t>(end - start)};
  }
  void known_run(std::size_t from, std::size_t count) {
    number(2 * count + 1);
    difference(static_cast<std::int64_t>(from) - static_cast<std::int64_t>(next_known_));
    next_known_ = from + count;
    last_ = known_[next_known_ - 1];
  }
  void new_run(const Ring& ring, std::size_t begin, std::size_t end) {
    if (begin == end) return;
    number(2 * (end - begin));
    for (std::size_t i = begin; i < end; ++i) {
      difference(std::int64_t{ring[i].x} - last_.x);
      difference(std::int64_t{ring[i].y} - last_.y);
      last_ = ring[i];
    }
  }
  void difference(std::int64_t value) {
    number((static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63));
  }

  std::vector<GridPoint> known_;
  std::map<GridPoint, std::size_t> place_;  // in known_
  std::size_t next_known_ = 0;
  GridPoint last_;
  std::vector<std::uint8_t> bytes_;
};

// After a fault every count is 0, so that whatever loops over it ends.
class Reader {
 public:
  Reader(std::span<const std::uint8_t> bytes, const Polygon& before)
      : bytes_(bytes), known_(geometry::vertices(before)) {}

  std::uint64_t count(std::uint64_t least, std::uint64_t most) {
    const std::uint64_t value = number();
    if (value < least || value > most) is_bad_ = true;
    return is_bad_ ? 0 : value;
  }

  Ring ring() {
    const std::uint64_t vertices = count(3, kMostVertices - vertices_);
    vertices_ += vertices;
    Ring ring;
    while (ring.size() < vertices && !is_bad_) {
      const std::uint64_t run = count(2, 2 * (vertices - ring.size()) + 1);
      if (run % 2 == 1) {
        known_run(run / 2, ring);
      } else {
        new_run(run / 2, ring);
      }
    }
    return ring;
  }

  bool is_good_and_at_end() const { return !is_bad_ && bytes_.empty(); }

 private:
  std::uint64_t number() {
    constexpr int kMostBits = 35;  // five bytes: any difference of two coordinates
    std::uint64_t value = 0;
    for (int shift = 0; shift < kMostBits && !bytes_.empty(); shift += 7) {
      const std::uint8_t byte = bytes_.front();
      bytes_ = bytes_.subspan(1);
      value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
      if (byte < 0x80) return value;
    }
    is_bad_ = true;
    return 0;
  }
  // `before` and a difference; 0 when that is not within the limits.
  std::int64_t number_after(std::int64_t before, std::int64_t least, std::int64_t most) {
    const std::uint64_t folded = number();
    const std::int64_t value =
        before + (static_cast<std::int64_t>(folded >> 1) ^ -static_cast<std::int64_t>(folded & 1));
    if (value < least || value > most) is_bad_ = true;
    return is_bad_ ? 0 : value;
  }
  void known_run(std::uint64_t count, Ring& ring) {
    const std::int64_t last = static_cast<std::int64_t>(known_.size() - count);
    const std::int64_t from = number_after(next_known_, 0, last);
    if (is_bad_) return;
    const auto begin = known_.begin() + from;
    ring.insert(ring.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
    next_known_ = from + static_cast<std::int64_t>(count);
    last_ = ring.back();
  }
  void new_run(std::uint64_t count, Ring& ring) {
    for (std::uint64_t i = 0; i < count && !is_bad_; ++i) {
      const std::int64_t x = number_after(last_.x, -kFarthest, kFarthest);
      const std::int64_t y = number_after(last_.y, -kFarthest, kFarthest);
      last_ = {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)};
      ring.push_back(last_);
    }
  }

  std::span<const std::uint8_t> bytes_;
  std::vector<GridPoint> known_;
  std::int64_t next_known_ = 0;
  GridPoint last_;
  std::uint64_t vertices_ = 0;
  bool is_bad_ = false;
};

}  // namespace

std::vector<std::uint8_t> encode_outline(const Polygon& polygon, const Polygon& before) {
  Writer writer(before);
  writer.number(polygon.parts.size());
  for (const PolygonPart& part : polygon.parts) {
    writer.number(1 + part.holes.size());
    writer.ring(part.outer);
    for (const Ring& hole : part.holes) writer.ring(hole);
  }
  return writer.take();
}

std::optional<Polygon> decode_outline(std::span<const std::uint8_t> bytes, const Polygon& before) {
  Reader reader(bytes, before);
  Polygon polygon;
  const std::uint64_t parts = reader.count(1, kMostRings);
  for (std::uint64_t i = 0; i < parts; ++i) {
    PolygonPart part;
    const std::uint64_t rings = reader.count(1, kMostRings);
    if (rings == 0) return std::nullopt;
    part.outer = reader.ring();
    for (std::uint64_t hole = 1; hole < rings; ++hole) part.holes.push_back(reader.ring());
    polygon.parts.push_back(std::move(part));
  }
  if (!reader.is_good_and_at_end() || !geometry::find_fault(polygon).empty()) return std::nullopt;
  return polygon;
}

}  // namespace geomap::mapping
