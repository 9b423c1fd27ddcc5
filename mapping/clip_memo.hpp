// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <variant>

#include "geometry/planar_polygon.hpp"

namespace geomap::mapping {

/// @brief Remembers the polygon operations of merging by their operands. A map that is folded again
/// after an undo or the loss of a key frame does most of them as before, and they are nearly all
/// that folding costs. Results are the same with and without it, to the last bit.
///
/// Holds the newest results, up to a size; not for several threads at a time.
class ClipMemo {
 public:
  /// @param most_bytes of results, roughly.
  explicit ClipMemo(std::size_t most_bytes = 48 << 20) : most_bytes_(most_bytes) {}

  /// @brief surface.in_frame(frame).
  geometry::Polygon in_frame(const geometry::PlanarPolygon& surface,
                             const geometry::PlaneFrame& frame);
  /// @brief Moments of the area that both cover when the smaller one has grown by `gap` [m].
  geometry::AreaMoments overlap(const geometry::Polygon& a, const geometry::Polygon& b, double gap);
  /// @brief united_outline() of fuse.hpp.
  geometry::Polygon united_outline(const geometry::Polygon& old_outline,
                                   const geometry::Polygon& added, double tolerance);

  std::int64_t hits() const { return hits_; }

 private:
  using Key = std::array<std::uint8_t, 32>;
  using Result = std::variant<geometry::Polygon, geometry::AreaMoments>;
  class KeyWriter;

  template <class Value, class Compute>
  Value remember(const Key& key, const Compute& compute);

  std::size_t most_bytes_;
  std::size_t bytes_ = 0;  // of the newer half
  std::map<Key, Result> newer_, older_;
  std::int64_t hits_ = 0;
};

}  // namespace geomap::mapping
