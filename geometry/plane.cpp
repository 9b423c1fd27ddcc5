// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane.hpp"

#include <cmath>

namespace geomap::geometry {

double angle_between(const Plane& a, const Plane& b) {
  return std::atan2(a.normal.cross(b.normal).norm(), a.normal.dot(b.normal));
}

}  // namespace geomap::geometry
