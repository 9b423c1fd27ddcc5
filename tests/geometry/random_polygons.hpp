// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <initializer_list>
#include <random>
#include <string>

#include "geometry/polygon.hpp"

namespace geomap::testing {

/// @brief Seeded shapes for property tests: the same on every machine (no std:: distributions).
class RandomShapes {
 public:
  explicit RandomShapes(std::uint32_t seed) : generator_(seed) {}

  /// @brief Whole number in [0, bound).
  std::int32_t below(std::int32_t bound);
  /// @brief Number in [from, to).
  double between(double from, double to);
  /// @brief Standard normal (Box-Muller).
  double normal();

  /// @brief Any corners on a 12x12 grid with `step` units between its lines: crossing, touching and
  /// repeated vertices everywhere.
  geometry::Ring coarse_ring(int corners, std::int32_t step);
  /// @brief A valid polygon from two such rings, read even-odd.
  geometry::Polygon coarse_polygon(std::int32_t step);
  /// @brief Star-shaped ring of radius 1 m about a centre, its radius uneven by +-`roughness`.
  geometry::Ring jagged_ring(int corners, double roughness, const Eigen::Vector2d& center,
                             double radius = 1.0);
  /// @brief Valid polygon with a jagged outline and, inside, a jagged hole.
  geometry::Polygon jagged_polygon(int corners, double roughness,
                                   const Eigen::Vector2d& center = Eigen::Vector2d::Zero());

 private:
  std::mt19937 generator_;
};

/// @brief Axis-aligned rectangle, counter-clockwise [grid unit].
geometry::Ring box_ring(std::int32_t left, std::int32_t lower, std::int32_t right,
                        std::int32_t upper);
/// @brief A valid polygon from rings read even-odd.
geometry::Polygon polygon_of(const std::vector<geometry::Ring>& rings);
/// @brief The polygon moved by whole grid units.
geometry::Polygon shifted(geometry::Polygon polygon, std::int32_t x, std::int32_t y);
/// @brief Total length of all rings [m].
double outline_length(const geometry::Polygon& polygon);
/// @brief Distance of a point from the nearest edge [m].
double distance_to_outline(const geometry::Polygon& polygon, const Eigen::Vector2d& point);

}  // namespace geomap::testing
