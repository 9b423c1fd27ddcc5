// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/clip_memo.hpp"

#include <openssl/sha.h>

#include <utility>
#include <vector>

#include "geometry/polygon_clip.hpp"
#include "mapping/fuse.hpp"

namespace geomap::mapping {

using geometry::AreaMoments;
using geometry::Polygon;

/// The operands of an operation as bytes, which tell it from every other one.
class ClipMemo::KeyWriter {
 public:
  explicit KeyWriter(std::uint8_t operation) { bytes_.push_back(operation); }

  KeyWriter& add(double value) { return add_bytes(&value, sizeof(value)); }
  KeyWriter& add(const Eigen::Vector3d& v) { return add_bytes(v.data(), 3 * sizeof(double)); }
  KeyWriter& add(const geometry::PlaneFrame& frame) {
    return add(frame.origin).add(frame.x_axis).add(frame.normal);
  }
  KeyWriter& add(const Polygon& polygon) {
    add_size(polygon.parts.size());
    for (const geometry::PolygonPart& part : polygon.parts) {
      add_size(part.holes.size());
      add(part.outer);
      for (const geometry::Ring& hole : part.holes) add(hole);
    }
    return *this;
  }

  Key key() const {
    Key key;
    SHA256(bytes_.data(), bytes_.size(), key.data());
    return key;
  }

 private:
  KeyWriter& add(const geometry::Ring& ring) {
    add_size(ring.size());
    return add_bytes(ring.data(), ring.size() * sizeof(geometry::GridPoint));
  }
  void add_size(std::size_t size) { add_bytes(&size, sizeof(size)); }
  KeyWriter& add_bytes(const void* data, std::size_t size) {
    const auto* begin = static_cast<const std::uint8_t*>(data);
    bytes_.insert(bytes_.end(), begin, begin + size);
    return *this;
  }

  std::vector<std::uint8_t> bytes_;
};

namespace {

std::size_t size_of(const Polygon& polygon) {
  return 150 + sizeof(geometry::GridPoint) * geometry::vertex_count(polygon);
}
std::size_t size_of(const AreaMoments&) { return 200; }

}  // namespace

// The older half goes when the newer one is full; what is used again moves to the newer one.
template <class Value, class Compute>
Value ClipMemo::remember(const Key& key, const Compute& compute) {
  if (const auto found = newer_.find(key); found != newer_.end()) {
    ++hits_;
    return std::get<Value>(found->second);
  }
  Value value;
  if (auto found = older_.extract(key)) {
    ++hits_;
    value = std::get<Value>(std::move(found.mapped()));
  } else {
    value = compute();
  }
  bytes_ += size_of(value);
  newer_.emplace(key, value);
  if (bytes_ > most_bytes_ / 2) {
    older_ = std::exchange(newer_, {});
    bytes_ = 0;
  }
  return value;
}

Polygon ClipMemo::in_frame(const geometry::PlanarPolygon& surface,
                           const geometry::PlaneFrame& frame) {
  const Key key = KeyWriter('f')
                      .add(surface.plane.normal)
                      .add(surface.plane.d)
                      .add(surface.frame)
                      .add(surface.polygon)
                      .add(frame)
                      .key();
  return remember<Polygon>(key, [&] { return surface.in_frame(frame); });
}

AreaMoments ClipMemo::overlap(const Polygon& a, const Polygon& b, double gap) {
  return remember<AreaMoments>(KeyWriter('o').add(a).add(b).add(gap).key(), [&] {
    return geometry::area_moments(geometry::area(a) < geometry::area(b)
                                      ? geometry::intersect(geometry::offset(a, gap), b)
                                      : geometry::intersect(a, geometry::offset(b, gap)));
  });
}

Polygon ClipMemo::united_outline(const Polygon& old_outline, const Polygon& added,
                                 double tolerance) {
  return remember<Polygon>(KeyWriter('u').add(old_outline).add(added).add(tolerance).key(),
                           [&] { return mapping::united_outline(old_outline, added, tolerance); });
}

}  // namespace geomap::mapping
