// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <compare>
#include <cstdint>
#include <string>
#include <vector>

namespace geomap::geometry {

/// @brief Size of one grid unit of polygon coordinates [m].
inline constexpr double kGridUnit = 1e-4;

/// @brief A vertex on the 0.1 mm grid of a plane frame. Whole numbers, so that a polygon is the
/// same to the last bit in memory, on the wire and in a file.
struct GridPoint {
  std::int32_t x = 0;  // [0.1 mm]
  std::int32_t y = 0;  // [0.1 mm]
  auto operator<=>(const GridPoint&) const = default;
};

/// @brief Nearest grid point of a point [m]. @throws std::invalid_argument when it is not finite or
/// farther than 100 km from the origin.
GridPoint to_grid(const Eigen::Vector2d& point);
inline Eigen::Vector2d to_metres(GridPoint p) { return {p.x * kGridUnit, p.y * kGridUnit}; }

/// @brief Closed ring; the last vertex is joined to the first one.
using Ring = std::vector<GridPoint>;

/// @brief The rectangle between two corners [m], counter-clockwise.
inline Ring rectangle(const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  return {to_grid(low), to_grid({high.x(), low.y()}), to_grid(high), to_grid({low.x(), high.y()})};
}

/// @brief One connected area: outer ring counter-clockwise, holes clockwise.
struct PolygonPart {
  Ring outer;
  std::vector<Ring> holes;
  auto operator<=>(const PolygonPart&) const = default;
};

/// @brief Area on a plane: any number of parts, each with any number of holes.
///
/// Invariant of every polygon this library returns (`find_fault` tells a breach): every ring is
/// simple (no crossing, no touching of itself, no repeated vertex), has at least three vertices and
/// a non-zero area; outer rings run counter-clockwise, holes clockwise; a hole lies inside its
/// outer ring, no two rings cross. Different rings may touch in points. Rings start at their
/// smallest vertex and are sorted, so equal areas with equal vertices compare equal.
struct Polygon {
  std::vector<PolygonPart> parts;
  bool empty() const { return parts.empty(); }
  auto operator<=>(const Polygon&) const = default;
};

/// @brief Area, centroid and second central moments of an area, exact integrals over the polygon.
struct AreaMoments {
  double area = 0.0;                                     // [m²]
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();    // [m]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // [m²]
};

/// @brief Signed area [m²], positive counter-clockwise.
double signed_area(const Ring& ring);
double area(const Polygon& polygon);
AreaMoments area_moments(const Polygon& polygon);

/// @brief The vertices of all rings: part after part, outer ring before holes.
std::vector<GridPoint> vertices(const Polygon& polygon);

/// @brief Number of vertices of all rings.
std::size_t vertex_count(const Polygon& polygon);

/// @brief Bounding box [m]; empty for an empty polygon.
Eigen::AlignedBox2d bounding_box(const Polygon& polygon);

/// @brief True for a point inside or on the border.
bool contains(const Polygon& polygon, const Eigen::Vector2d& point);

/// @brief True when no two edges cross or touch, except neighbours in their common vertex.
bool is_simple(const Ring& ring);

/// @brief What breaks the invariant, in words; empty for a valid polygon.
std::string find_fault(const Polygon& polygon);

/// @brief The same for a polygon whose rings are known to be simple and not to cross: only their
/// orientation and nesting are looked at.
std::string find_nesting_fault(const Polygon& polygon);

/// @brief The same polygon with rings rotated to their smallest vertex, and holes and parts sorted.
Polygon canonical(Polygon polygon);

}  // namespace geomap::geometry
