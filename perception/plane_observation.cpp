// SPDX-License-Identifier: BSD-3-Clause
#include "perception/plane_observation.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/polygon_simplify.hpp"

namespace geomap::perception {
namespace {

// A depth camera's noise is alike within about this many pixels: as many count as one independent one.
constexpr double kCorrelatedPixels = 64.0;

geometry::PlaneObservation without_surface(const PlaneSums& sums) {
  geometry::PlaneObservation observation;
  observation.moments = sums.moments;
  observation.inliers = sums.pixels;
  for (std::size_t k = 0; k < 3; ++k) {
    observation.color[k] = sums.color[k] / std::max(1, sums.pixels);
  }
  return observation;
}

bool is_known_well(const geometry::PlaneFit& fit, std::int64_t inliers, const PartGates& gates) {
  const double independent = std::max(1.0, static_cast<double>(inliers) / kCorrelatedPixels);
  return fit.rms * fit.rms <=
         gates.max_normal_error * gates.max_normal_error * fit.extent.y() * independent;
}

bool is_flat(const geometry::PlaneFit& fit, const geometry::PlaneMoments& moments,
             const DepthTolerance& tolerance, double cosine, const PartGates& gates) {
  const Eigen::Vector3d& n = fit.plane.normal;
  const double noise = n.dot(moments.noise * n) / moments.weight;  // along the normal [m²]
  const double systematic = 0.5 * cosine * tolerance.systematic_along_ray(fit.centroid.z());
  return fit.rms <= gates.max_rms_ratio * std::sqrt(noise + systematic * systematic) +
                        0.5 * tolerance.unevenness;
}

}  // namespace

std::optional<geometry::PlaneObservation> observe(const geometry::CameraModel& camera,
                                                  const PlanePart& part,
                                                  const DepthTolerance& tolerance,
                                                  const PartGates& gates) {
  geometry::PlaneObservation observation = without_surface(part.sums);
  if (observation.inliers < gates.min_pixels) return std::nullopt;
  const auto fit = observation.moments.fit(-observation.moments.centroid());
  if (!fit || !is_known_well(*fit, observation.inliers, gates)) return std::nullopt;
  const geometry::Plane& plane = fit->plane;
  const double view_cosine = -plane.normal.dot(fit->centroid.normalized());
  if (view_cosine < gates.min_view_cosine) return std::nullopt;
  const double ray_cosine = -plane.normal.dot(fit->centroid) / fit->centroid.z();
  if (!is_flat(*fit, observation.moments, tolerance, ray_cosine, gates)) return std::nullopt;

  observation.rms = fit->rms;
  geometry::PlanarPolygon& surface = observation.surface;
  surface.plane = plane;
  surface.frame = geometry::PlaneFrame::on(plane, fit->centroid, Eigen::Vector3d::UnitX(),
                                           Eigen::Vector3d::UnitY());
  const geometry::Polygon outline = part_polygon(camera, plane, surface.frame, part);
  const double pixel = pixel_length(camera, plane, camera.project(fit->centroid));
  surface.polygon = geometry::simplify(outline, gates.simplify_tolerance + pixel);
  const double area = geometry::area(surface.polygon);
  if (area < gates.min_area) return std::nullopt;
  if (part.covered < gates.min_fill * area) return std::nullopt;
  return observation;
}

}  // namespace geomap::perception
