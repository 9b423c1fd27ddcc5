// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "geometry/polygon.hpp"

namespace geomap::geometry {

/// Exact decisions on grid points. Differences of 32-bit coordinates need 33 bits and their
/// products 66, so that every sign below is right, however far the points lie from the origin.
__extension__ using Int128 = __int128;

inline std::int64_t dx(GridPoint from, GridPoint to) { return std::int64_t{to.x} - from.x; }
inline std::int64_t dy(GridPoint from, GridPoint to) { return std::int64_t{to.y} - from.y; }

/// @brief Cross product of (b - a) and (d - c).
inline Int128 cross(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
  return Int128{dx(a, b)} * dy(c, d) - Int128{dy(a, b)} * dx(c, d);
}

/// @brief Dot product of (b - a) and (d - c).
inline Int128 dot(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
  return Int128{dx(a, b)} * dx(c, d) + Int128{dy(a, b)} * dy(c, d);
}

inline int sign(Int128 value) { return (value > 0) - (value < 0); }

/// @brief 1 when c lies left of the line from a to b, -1 when right, 0 when on it.
inline int orientation(GridPoint a, GridPoint b, GridPoint c) {
  std::int64_t p = 0, q = 0;  // 64 bits are enough but for points at opposite ends of the grid
  const bool is_wide = __builtin_mul_overflow(dx(a, b), dy(a, c), &p) ||
                       __builtin_mul_overflow(dy(a, b), dx(a, c), &q);
  return is_wide ? sign(cross(a, b, a, c)) : (p > q) - (p < q);
}

/// @brief Twice the signed area [grid unit²], positive counter-clockwise.
inline Int128 twice_area(const Ring& ring) {
  Int128 sum = 0;
  for (std::size_t i = 2; i < ring.size(); ++i)
    sum += cross(ring[0], ring[i - 1], ring[0], ring[i]);
  return sum;
}

/// @brief How two segments (each longer than a point) meet.
enum class Meeting {
  kApart,
  kTouch,    // one common point, the end of at least one of them
  kCross,    // one common point, inside both
  kOverlap,  // a common stretch
};

inline Meeting meeting(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
  const int c_side = orientation(a, b, c), d_side = orientation(a, b, d);
  if (c_side * d_side > 0) return Meeting::kApart;
  if (c_side == 0 && d_side == 0) {
    const GridPoint first = std::max(std::min(a, b), std::min(c, d));
    const GridPoint last = std::min(std::max(a, b), std::max(c, d));
    if (last < first) return Meeting::kApart;
    return first == last ? Meeting::kTouch : Meeting::kOverlap;
  }
  const int a_side = orientation(c, d, a), b_side = orientation(c, d, b);
  if (a_side * b_side > 0) return Meeting::kApart;
  return c_side * d_side < 0 && a_side * b_side < 0 ? Meeting::kCross : Meeting::kTouch;
}

/// @brief x + 1/2, rounded down, for a quotient x whose denominator is positive.
inline std::int32_t rounded_quotient(Int128 numerator, Int128 denominator) {
  const Int128 n = 2 * numerator + denominator, d = 2 * denominator;
  Int128 quotient = n / d;
  if (n % d < 0) --quotient;
  return static_cast<std::int32_t>(quotient);
}

/// @brief Grid cell of the point where the segments ab and cd, which cross, do so.
inline GridPoint crossing_cell(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
  Int128 numerator = cross(a, c, c, d), denominator = cross(a, b, c, d);
  if (denominator < 0) {
    numerator = -numerator;
    denominator = -denominator;
  }
  return {a.x + rounded_quotient(dx(a, b) * numerator, denominator),
          a.y + rounded_quotient(dy(a, b) * numerator, denominator)};
}

/// @brief True when q, seen from the corner prev -> at -> next, lies strictly on its left. q must
/// not lie on one of the two arms.
inline bool left_of_corner(GridPoint prev, GridPoint at, GridPoint next, GridPoint q) {
  const int turn = orientation(prev, at, next);
  const int from_first = orientation(prev, at, q), from_second = orientation(at, next, q);
  if (turn > 0) return from_first > 0 && from_second > 0;
  if (turn < 0) return !(from_first < 0 && from_second < 0);
  return from_first > 0;
}

}  // namespace geomap::geometry
