// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/outline_code.hpp"

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

class Writer {
 public:
  void number(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) {
      bytes_.push_back(static_cast<std::uint8_t>(value | 0x80));
    }
    bytes_.push_back(static_cast<std::uint8_t>(value));
  }
  void ring(const Ring& ring) {
    number(ring.size());
    for (const GridPoint vertex : ring) {
      difference(std::int64_t{vertex.x} - last_.x);
      difference(std::int64_t{vertex.y} - last_.y);
      last_ = vertex;
    }
  }
  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  void difference(std::int64_t value) {
    number((static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63));
  }

  std::vector<std::uint8_t> bytes_;
  GridPoint last_;
};

// After a fault every number is 0, so that whatever loops over counts ends.
class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::uint64_t count(std::uint64_t least, std::uint64_t most) {
    const std::uint64_t value = number();
    if (value < least || value > most) is_bad_ = true;
    return is_bad_ ? 0 : value;
  }
  Ring ring() {
    const std::uint64_t vertices = count(3, kMostVertices - vertices_);
    vertices_ += vertices;
    Ring ring;
    for (std::uint64_t i = 0; i < vertices && !is_bad_; ++i) {
      last_ = {coordinate(last_.x), coordinate(last_.y)};
      ring.push_back(last_);
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
  std::int32_t coordinate(std::int32_t before) {
    const std::uint64_t folded = number();
    const std::int64_t value =
        before + (static_cast<std::int64_t>(folded >> 1) ^ -static_cast<std::int64_t>(folded & 1));
    if (value < -kFarthest || value > kFarthest) is_bad_ = true;
    return is_bad_ ? 0 : static_cast<std::int32_t>(value);
  }

  std::span<const std::uint8_t> bytes_;
  GridPoint last_;
  std::uint64_t vertices_ = 0;
  bool is_bad_ = false;
};

}  // namespace

std::vector<std::uint8_t> encode_outline(const Polygon& polygon) {
  Writer writer;
  writer.number(polygon.parts.size());
  for (const PolygonPart& part : polygon.parts) {
    writer.number(1 + part.holes.size());
    writer.ring(part.outer);
    for (const Ring& hole : part.holes) writer.ring(hole);
  }
  return writer.take();
}

std::optional<Polygon> decode_outline(std::span<const std::uint8_t> bytes) {
  Reader reader(bytes);
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
