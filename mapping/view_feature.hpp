// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "geometry/planar_polygon.hpp"
#include "mapping/map_feature.hpp"

namespace geomap::mapping {

/// @brief One surface as the operator sees it: in whole numbers, so that it is the same to the last
/// bit wherever it has been sent. World frame (z up).
///
/// The polygon's frame lies on the plane itself. The map's may be turned against it by half a
/// degree; leaving that out stretches the outline by less than 4e-5 of its size.
struct ViewFeature {
  FeatureId id;
  std::array<std::int32_t, 3> origin{};  // of the frame, a point of the plane [0.1 mm]
  std::array<std::int32_t, 3> normal{};  // towards the side that was seen [1e-6]
  std::array<std::int16_t, 3> x_axis{};  // of the frame [1/30000]
  geometry::Polygon polygon;             // frame's coordinates

  std::int16_t observations = 0;        // key frames' planes in it
  std::int16_t rms = 0;                 // of the points about the plane [0.1 mm]
  std::int16_t sigma_angle = 0;         // of the normal [1e-5 rad]
  std::int16_t sigma_d = 0;             // of the offset at the centroid [0.1 mm]
  std::array<std::uint8_t, 3> color{};  // red, green, blue
  bool locked = false;                  // by the operator, against merging
  std::string label;                    // given by the operator; empty: none

  bool operator==(const ViewFeature&) const = default;
};

/// @brief The nearest view of a feature. What is beyond a number's range is cut off there: 200 km
/// of the origin, 3 m of a deviation.
ViewFeature quantised(const MapFeature& feature);

/// @brief The surface in metres.
geometry::PlanarPolygon surface_of(const ViewFeature& feature);

/// @brief True when both axes are of unit length and at right angles, as far as whole numbers can
/// be, and no number is negative that cannot be. Does not look at the polygon.
bool is_sound(const ViewFeature& feature);

/// @brief What an operator does not need to be told.
struct ViewTolerance {
  double distance = 0.001;    // of border or plane from what was sent [m]
  double area_share = 0.005;  // of the area
};

/// @brief True when the surface has moved or its area changed beyond the tolerance, or what the
/// operator himself sets has changed. Counts and deviations alone do not matter.
bool looks_different(const ViewFeature& sent, const ViewFeature& now,
                     const ViewTolerance& tolerance);

}  // namespace geomap::mapping
