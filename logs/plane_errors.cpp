// SPDX-License-Identifier: BSD-3-Clause
#include "logs/plane_errors.hpp"

#include <cmath>
#include <cstddef>

namespace geomap::logs {

double vertex_rms(const geometry::PlanarPolygon& surface, const geometry::Plane& truth) {
  double sum = 0.0;
  std::size_t count = 0;
  const auto add = [&](const geometry::Ring& ring) {
    for (const geometry::GridPoint vertex : ring) {
      const double distance = truth.signed_distance(surface.lift(vertex));
      sum += distance * distance;
      ++count;
    }
  };
  for (const geometry::PolygonPart& part : surface.polygon.parts) {
    add(part.outer);
    for (const geometry::Ring& hole : part.holes) add(hole);
  }
  return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0;
}

PlaneErrors plane_errors(const geometry::PlanarPolygon& surface, const geometry::Plane& truth,
                         const Eigen::Vector3d& at) {
  const geometry::Plane& plane = surface.plane;
  PlaneErrors errors;
  errors.dist = std::abs(plane.d - truth.d);
  errors.coeff = std::hypot((plane.normal - truth.normal).norm(), errors.dist);
  errors.angle = geometry::angle_between(plane, truth);
  errors.dist_local = std::abs(plane.signed_distance(at));
  errors.rms_p = vertex_rms(surface, truth);
  return errors;
}

PlaneErrors mean_of(std::span<const PlaneErrors> errors) {
  PlaneErrors mean;
  if (errors.empty()) return mean;
  const double share = 1.0 / static_cast<double>(errors.size());
  for (double PlaneErrors::*measure : {&PlaneErrors::coeff, &PlaneErrors::angle, &PlaneErrors::dist,
                                       &PlaneErrors::dist_local, &PlaneErrors::rms_p}) {
    for (const PlaneErrors& one : errors) mean.*measure += one.*measure;
    mean.*measure *= share;
  }
  return mean;
}

}  // namespace geomap::logs
