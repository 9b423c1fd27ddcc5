// SPDX-License-Identifier: BSD-3-Clause
#include "perception/plane_observation.hpp"

#include <algorithm>
#include <cmath>

#include "perception/part_curvature.hpp"
#include "perception/plane_extractor.hpp"
#include "perception/plane_rays.hpp"

namespace geomap::perception {
namespace {

// A depth camera's noise is alike within about this many pixels: as many count as one independent
// one.
constexpr double kCorrelatedPixels = 64.0;

constexpr double kLeastViewCosine = 0.1;     // |n·ray|: views more grazing do not decide a side
constexpr double kLargestNormalError = 0.1;  // standard deviation of the normal [rad]

constexpr double kWhiteRmsRatio = 1.2;  // largest rms over what white noise makes it
constexpr double kLeastBow = 0.25;      // of what is bent, over the unevenness of what is flat

bool is_known_well(const geometry::PlaneFit& fit, std::int64_t inliers) {
  const double independent = std::max(1.0, static_cast<double>(inliers) / kCorrelatedPixels);
  return fit.rms * fit.rms <=
         kLargestNormalError * kLargestNormalError * fit.extent.y() * independent;
}

bool is_flat(const geometry::PlaneFit& fit, const geometry::PlaneMoments& moments,
             const DepthTolerance& tolerance, double cosine, const ExtractionConfig& config) {
  const Eigen::Vector3d& n = fit.plane.normal;
  const double noise = n.dot(moments.noise * n) / moments.weight;  // along the normal [m²]
  const double systematic = 0.5 * cosine * tolerance.systematic_along_ray(fit.centroid.z());
  const double ratio =
      tolerance.is_white() ? std::min(kWhiteRmsRatio, config.max_rms_ratio) : config.max_rms_ratio;
  return fit.rms <= ratio * std::sqrt(noise + systematic * systematic) + 0.5 * tolerance.unevenness;
}

// A cylinder or a sphere, and no plane: its curvature is beyond doubt, and the bow more than the
// camera's systematic error could make. Narrow strips of a pillar bow by less than flat surfaces
// are granted to be uneven, but all of them evenly.
bool is_curved(const std::vector<CellPoint>& part, const geometry::PlaneFit& fit,
               const DepthTolerance& tolerance, double cosine, const ExtractionConfig& config) {
  const auto curvature = curvature_of(part, fit);
  return curvature && curvature->value - 3.0 * curvature->sigma > config.max_curvature &&
         curvature->sagitta > kLeastBow * tolerance.unevenness +
                                  cosine * tolerance.systematic_along_ray(fit.centroid.z());
}

double covered_area(const geometry::CameraModel& camera, const geometry::Plane& plane,
                    const PlanePart& part) {
  double sum = 0.0;
  for (const PlaneCell* cell : part) {
    const Eigen::Vector2d center = cell->box.cast<double>().center();
    if (meets(camera, plane, center)) sum += cell->pixels * pixel_area(camera, plane, center);
  }
  return sum;
}

// The part as a plane in its frame; nothing where it turns out to be none, or one that cannot be
// known.
std::optional<geometry::PlaneObservation> observe(const PartSums& sums,
                                                  const DepthTolerance& tolerance,
                                                  const ExtractionConfig& config) {
  if (sums.pixels < config.min_pixels) return std::nullopt;
  const auto fit = sums.moments.fit(-sums.moments.centroid());
  if (!fit || !is_known_well(*fit, sums.pixels)) return std::nullopt;
  const geometry::Plane& plane = fit->plane;
  const Eigen::Vector3d& centroid = fit->centroid;
  if (-plane.normal.dot(centroid.normalized()) < kLeastViewCosine) return std::nullopt;
  const double ray_cosine = -plane.normal.dot(centroid) / centroid.z();
  if (!is_flat(*fit, sums.moments, tolerance, ray_cosine, config)) return std::nullopt;
  if (is_curved(sums.points, *fit, tolerance, ray_cosine, config)) return std::nullopt;
  geometry::PlaneObservation observation;
  observation.moments = sums.moments;
  observation.inliers = sums.pixels;
  for (std::size_t k = 0; k < sums.color.size(); ++k) {
    observation.color[k] = sums.color[k] / static_cast<double>(sums.pixels);
  }
  observation.rms = fit->rms;
  observation.surface.plane = plane;
  observation.surface.frame =
      geometry::PlaneFrame::on(plane, centroid, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY());
  return observation;
}

}  // namespace

std::vector<FoundPart> find_parts(const ExtractionConfig& config, const geometry::RgbdFrame& frame,
                                  const DepthCells& cells, const DepthTolerance& tolerance,
                                  const std::vector<geometry::Plane>& planes,
                                  const PlanePixels& pixels,
                                  const std::optional<Eigen::Vector3d>& up_camera) {
  std::vector<FoundPart> found;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    for (PlanePart& part : split_into_parts(frame.depth_camera, cells.columns(), planes[i],
                                            pixels.cells[i], config.part_gap, config.min_pixels)) {
      const auto surface = static_cast<std::int16_t>(i);
      auto observation = observe(
          sum_part(frame, cells, tolerance.noise, pixels.label, surface, part), tolerance, config);
      if (!observation || !config.wants(observation->surface.plane, up_camera)) continue;
      found.push_back({std::move(*observation), surface, std::move(part)});
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const FoundPart& a, const FoundPart& b) {
    return a.observation.inliers > b.observation.inliers;
  });
  return found;
}

bool covers_enough(const geometry::CameraModel& camera,
                   const geometry::PlaneObservation& observation, const PlanePart& part,
                   const ExtractionConfig& config) {
  const double area = geometry::area(observation.surface.polygon);
  return area >= config.min_area &&
         covered_area(camera, observation.surface.plane, part) >= config.min_fill * area;
}

std::vector<std::int16_t> label_parts(const std::vector<FoundPart>& found,
                                      const std::vector<std::int16_t>& label, int width) {
  std::vector<std::int16_t> result(label.size(), kNoPlane);
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (const PlaneCell* cell : found[i].part) {
      for (int v = cell->box.min().y(); v <= cell->box.max().y(); ++v) {
        for (int u = cell->box.min().x(); u <= cell->box.max().x(); ++u) {
          const auto pixel = static_cast<std::size_t>(v * width + u);
          if (label[pixel] == found[i].surface) result[pixel] = static_cast<std::int16_t>(i);
        }
      }
    }
  }
  return result;
}

}  // namespace geomap::perception
