// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/polygon.hpp"

namespace geomap::geometry {

using Windings = std::array<int, 2>;  // winding number about each of two operands

/// @brief Tells from the winding numbers about a point, one for each operand, whether it is inside.
using InsideRule = bool (*)(int winding_a, int winding_b);

/// @brief A piece of an outline, a < b, with what it adds to the winding numbers on its left.
struct Fragment {
  GridPoint a, b;
  Windings step;
};

/// @brief The faces between fragments that meet in common ends only, with their winding numbers.
/// Half edge 2k runs along fragment k from a to b, 2k + 1 back.
class PlanarMap {
 public:
  /// @param fragments no two of them the same, at each vertex as many steps leaving as arriving.
  explicit PlanarMap(std::vector<Fragment> fragments) : fragments_(std::move(fragments)) {
    link();
    wind();
  }

  /// @brief Rings around what is inside, inside on their left, each through any vertex once.
  std::vector<Ring> boundary(InsideRule inside) const;

 private:
  using Index = std::uint32_t;

  static Index twin(Index h) { return h ^ 1U; }
  GridPoint origin(Index h) const { return h & 1U ? fragments_[h / 2].b : fragments_[h / 2].a; }
  Index size() const { return static_cast<Index>(2 * fragments_.size()); }

  void link();
  void wind();
  Windings above(Index fragment) const;

  std::vector<Fragment> fragments_;
  std::vector<Index> next_;     // the half edge after this one around the face on its left
  std::vector<Windings> left_;  // winding numbers of that face
};

}  // namespace geomap::geometry
