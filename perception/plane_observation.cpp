// SPDX-License-Identifier: BSD-3-Clause
#include "perception/plane_observation.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/polygon_simplify.hpp"
#include "perception/part_curvature.hpp"
#include "perception/plane_rays.hpp"

namespace geomap::perception {
namespace {

// A depth camera's noise is alike within about this many pixels: as many count as one independent
// one.
constexpr double kCorrelatedPixels = 64.0;

constexpr double kWhiteRmsRatio = 1.2;  // largest rms over what white noise makes it
constexpr double kLeastBow = 0.25;      // of what is bent, over the unevenness of what is flat

geometry::PlaneObservation without_surface(const PlanePart& part) {
  PlaneSums sums;
  for (const PlaneCell* cell : part) sums += cell->sums;
  geometry::PlaneObservation observation;
  observation.moments = sums.moments;
  observation.inliers = sums.pixels;
  for (std::size_t k = 0; k < sums.color.size(); ++k) {
    observation.color[k] = sums.color[k] / std::max(1, sums.pixels);
  }
  return observation;
}

bool is_known_well(const geometry::PlaneFit& fit, std::int64_t inliers,
                   const ObservationSettings& settings) {
  const double independent = std::max(1.0, static_cast<double>(inliers) / kCorrelatedPixels);
  return fit.rms * fit.rms <=
         settings.max_normal_error * settings.max_normal_error * fit.extent.y() * independent;
}

bool is_flat(const geometry::PlaneFit& fit, const geometry::PlaneMoments& moments,
             const DepthTolerance& tolerance, double cosine, const ObservationSettings& settings) {
  const Eigen::Vector3d& n = fit.plane.normal;
  const double noise = n.dot(moments.noise * n) / moments.weight;  // along the normal [m²]
  const double systematic = 0.5 * cosine * tolerance.systematic_along_ray(fit.centroid.z());
  const double ratio = tolerance.is_white() ? std::min(kWhiteRmsRatio, settings.max_rms_ratio)
                                            : settings.max_rms_ratio;
  return fit.rms <= ratio * std::sqrt(noise + systematic * systematic) + 0.5 * tolerance.unevenness;
}

// A cylinder or a sphere, and no plane: its curvature is beyond doubt, and the bow more than the
// camera's systematic error could make. Narrow strips of a pillar bow by less than flat surfaces
// are granted to be uneven, but all of them evenly.
bool is_curved(const PlanePart& part, const geometry::PlaneFit& fit,
               const DepthTolerance& tolerance, double cosine,
               const ObservationSettings& settings) {
  const auto curvature = curvature_of(part, fit);
  return curvature && curvature->value - 3.0 * curvature->sigma > settings.max_curvature &&
         curvature->sagitta > kLeastBow * tolerance.unevenness +
                                  cosine * tolerance.systematic_along_ray(fit.centroid.z());
}

double covered_area(const geometry::CameraModel& camera, const geometry::Plane& plane,
                    const PlanePart& part) {
  double sum = 0.0;
  for (const PlaneCell* cell : part) {
    const Eigen::Vector2d center = cell->box.cast<double>().center();
    if (meets(camera, plane, center)) sum += cell->sums.pixels * pixel_area(camera, plane, center);
  }
  return sum;
}

}  // namespace

std::optional<geometry::PlaneObservation> observe(const geometry::CameraModel& camera,
                                                  const LabelImage& image, std::int16_t index,
                                                  const PlanePart& part,
                                                  const DepthTolerance& tolerance,
                                                  const ObservationSettings& settings) {
  geometry::PlaneObservation observation = without_surface(part);
  if (observation.inliers < settings.min_pixels) return std::nullopt;
  const auto fit = observation.moments.fit(-observation.moments.centroid());
  if (!fit || !is_known_well(*fit, observation.inliers, settings)) return std::nullopt;
  const geometry::Plane& plane = fit->plane;
  const Eigen::Vector3d& centroid = fit->centroid;
  if (-plane.normal.dot(centroid.normalized()) < settings.min_view_cosine) return std::nullopt;
  const double ray_cosine = -plane.normal.dot(centroid) / centroid.z();
  if (!is_flat(*fit, observation.moments, tolerance, ray_cosine, settings)) return std::nullopt;
  if (is_curved(part, *fit, tolerance, ray_cosine, settings)) return std::nullopt;

  observation.rms = fit->rms;
  geometry::PlanarPolygon& surface = observation.surface;
  surface.plane = plane;
  surface.frame =
      geometry::PlaneFrame::on(plane, centroid, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY());
  const double pixel = pixel_length(camera, plane, camera.project(centroid));
  surface.polygon = geometry::simplify(
      part_outline(camera, plane, surface.frame, image, index, part, settings.alpha),
      settings.simplify_tolerance + pixel);
  const double area = geometry::area(surface.polygon);
  if (area < settings.min_area) return std::nullopt;
  if (covered_area(camera, plane, part) < settings.min_fill * area) return std::nullopt;
  return observation;
}

}  // namespace geomap::perception
