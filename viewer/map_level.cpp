// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/map_level.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace geomap::viewer {
namespace {

constexpr double kUpwards = 0.98;     // z of the normal, from which on a face is level
constexpr double kLeastArea = 0.2;    // [m2]; smaller ones may be noise below the floor
constexpr double kLeastOffset = 0.3;  // [m]

}  // namespace

double lowest_level(const Features& features) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  double lowest_floor = kNone, bottom = kNone;
  for (const auto& [id, feature] : features) {
    const geometry::PlanarPolygon surface = mapping::surface_of(feature);
    const Eigen::AlignedBox3d box = surface.bounding_box();
    if (box.isEmpty() || !std::isfinite(box.min().z())) continue;
    bottom = std::min(bottom, box.min().z());
    const bool is_level = surface.plane.normal.z() > kUpwards;
    if (!is_level || geometry::area(surface.polygon) < kLeastArea) continue;
    lowest_floor = std::min(lowest_floor, box.center().z());
  }
  const double level = std::isfinite(lowest_floor) ? lowest_floor : bottom;
  if (!std::isfinite(level) || std::abs(level) < kLeastOffset) return 0.0;
  return std::round(100.0 * level) / 100.0;
}

}  // namespace geomap::viewer
