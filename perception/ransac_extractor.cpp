// SPDX-License-Identifier: BSD-3-Clause
#include "perception/ransac_extractor.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "geometry/angles.hpp"
#include "perception/euclidean_clusters.hpp"
#include "perception/merge_planes.hpp"
#include "perception/noise_estimate.hpp"
#include "perception/pixel_labels.hpp"
#include "perception/plane_observation.hpp"
#include "perception/plane_parts.hpp"
#include "perception/plane_pixels.hpp"
#include "perception/ransac_planes.hpp"
#include "perception/voxel_cloud.hpp"

namespace geomap::perception {
namespace {

// The first assignment of pixels only has to be good enough to fit and merge planes.
constexpr int kFirstRowStep = 2;

using geometry::PlaneObservation;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

using geometry::radians;

void require_valid(const geometry::RgbdFrame& frame) {
  const geometry::DepthImage& depth = frame.depth;
  const auto pixels =
      static_cast<std::size_t>(depth.width) * static_cast<std::size_t>(depth.height);
  if (depth.width <= 0 || depth.height <= 0 || depth.millimetres.size() != pixels) {
    throw std::invalid_argument("plane extraction: the depth image's buffer has not its size");
  }
  if (!frame.depth_camera.valid() || frame.depth_camera.width != depth.width ||
      frame.depth_camera.height != depth.height) {
    throw std::invalid_argument("plane extraction: the depth camera is not that of the image");
  }
}

bool is_wanted(const RansacExtractorConfig& config, const geometry::Plane& plane,
               const std::optional<Eigen::Vector3d>& up_camera) {
  if (config.orientation == "any") return true;
  const double rise = std::abs(plane.normal.dot(up_camera->normalized()));
  const double tilt = radians(config.max_tilt_deg);
  return config.orientation == "horizontal" ? rise >= std::cos(tilt) : rise <= std::sin(tilt);
}

DepthTolerance tolerance_of(const RansacExtractorConfig& config, const DepthCells& cells) {
  geometry::DepthNoise model;
  model.factor = config.noise_factor;
  DepthTolerance tolerance;
  tolerance.noise = config.noise == "auto" ? estimate_noise(cells, model) : model;
  tolerance.gate = config.noise_gate;
  tolerance.systematic = config.systematic_error;
  return tolerance;
}

ObservationSettings observation_settings(const RansacExtractorConfig& config) {
  ObservationSettings settings;
  settings.min_area = config.min_area;
  settings.min_pixels = config.min_pixels;
  settings.min_fill = config.min_fill;
  settings.max_rms_ratio = config.max_rms_ratio;
  settings.max_curvature = config.max_curvature;
  settings.alpha = config.alpha;
  settings.simplify_tolerance = config.simplify_tolerance;
  return settings;
}

// Which cell is on which plane, from its voxel.
std::vector<std::int16_t> label_cells(const VoxelCloud& cloud,
                                      const std::vector<VoxelPlane>& planes) {
  std::vector<std::int16_t> of_voxel(cloud.voxels.size(), kNoPlane);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    for (const int voxel : planes[i].voxels) {
      of_voxel[static_cast<std::size_t>(voxel)] = static_cast<std::int16_t>(i);
    }
  }
  std::vector<std::int16_t> of_cell(cloud.voxel_of_cell.size(), kNoPlane);
  for (std::size_t i = 0; i < of_cell.size(); ++i) {
    const int voxel = cloud.voxel_of_cell[i];
    if (voxel >= 0) of_cell[i] = of_voxel[static_cast<std::size_t>(voxel)];
  }
  return of_cell;
}

// The depth beyond which voxels and cluster tolerance grow: cells are not denser there than this
// share of a voxel (2.5 m for a Kinect and 4 cm).
double even_density_depth(const RansacExtractorConfig& config,
                          const geometry::CameraModel& camera) {
  constexpr double kCellsOfVoxel = 0.43;
  return kCellsOfVoxel * config.voxel_size * std::min(camera.fx, camera.fy) / DepthCells::kSide;
}

// As many as labels of 16 bits can name.
constexpr std::size_t kMostPlanes = std::numeric_limits<std::int16_t>::max();

std::vector<VoxelPlane> find_planes(const RansacExtractorConfig& config, const VoxelCloud& cloud,
                                    double reference, const DepthTolerance& tolerance,
                                    std::uint64_t seed) {
  RansacSettings settings;
  settings.iterations = config.ransac_iterations;
  settings.least_voxels = config.min_cluster_voxels;
  settings.max_normal_angle = radians(config.max_normal_angle_deg);
  std::vector<VoxelPlane> planes;
  for (const std::vector<int>& cluster :
       euclidean_clusters(cloud, config.cluster_tolerance, reference, config.min_cluster_voxels)) {
    for (VoxelPlane& plane : ransac_planes(cloud, cluster, tolerance, settings, seed++)) {
      if (planes.size() == kMostPlanes) return planes;
      planes.push_back(std::move(plane));
    }
  }
  return planes;
}

// Planes as RANSAC found them, and the cells that are on them.
struct Seeds {
  std::vector<geometry::Plane> planes;
  std::vector<std::int16_t> cell_label;
};

// Paper: voxel filter, Euclidean clusters, RANSAC.
Seeds find_seeds(const RansacExtractorConfig& config, const geometry::CameraModel& camera,
                 const DepthCells& cells, const std::vector<CellNormal>& normals,
                 const DepthTolerance& tolerance, std::uint64_t seed) {
  const double reference = even_density_depth(config, camera);
  const VoxelCloud cloud = make_voxel_cloud(cells, normals, config.voxel_size, reference);
  const std::vector<VoxelPlane> found = find_planes(config, cloud, reference, tolerance, seed);
  Seeds seeds;
  for (const VoxelPlane& plane : found) seeds.planes.push_back(plane.plane);
  seeds.cell_label = label_cells(cloud, found);
  return seeds;
}

struct Surfaces {
  std::vector<geometry::Plane> planes;
  PlanePixels pixels;
};

// From seeds to all pixels: a quick assignment to fit and merge, then the final one.
Surfaces grow_surfaces(const RansacExtractorConfig& config, const geometry::RgbdFrame& frame,
                       const DepthCells& cells, const DepthTolerance& tolerance,
                       const PixelLabeler& labeler, const Seeds& seeds) {
  const PlanePixels first = sum_pixels(frame, cells, tolerance.noise,
                                       labeler.label(seeds.planes, seeds.cell_label, kFirstRowStep),
                                       seeds.planes.size(), kFirstRowStep);
  FittedPlanes fitted =
      fit_and_merge(cells, first, tolerance, radians(config.max_merge_angle_deg), kFirstRowStep);
  Surfaces surfaces;
  surfaces.pixels =
      sum_pixels(frame, cells, tolerance.noise, labeler.label(fitted.planes, fitted.cell_label),
                 fitted.planes.size());
  surfaces.planes = std::move(fitted.planes);
  return surfaces;
}

// A plane to report, and the pixels that are on it: those of a part with that surface's label.
struct Found {
  PlaneObservation observation;
  std::int16_t surface = kNoPlane;
  PlanePart part;
};

// Paper: clustering of the inliers, concave hull.
std::vector<Found> outline_surfaces(const RansacExtractorConfig& config,
                                    const geometry::RgbdFrame& frame, const DepthCells& cells,
                                    const DepthTolerance& tolerance, const Surfaces& surfaces,
                                    const std::optional<Eigen::Vector3d>& up_camera) {
  const geometry::CameraModel& camera = frame.depth_camera;
  const LabelImage image{surfaces.pixels.label, frame.depth.width};
  const ObservationSettings settings = observation_settings(config);
  std::vector<Found> found;
  for (std::size_t i = 0; i < surfaces.planes.size(); ++i) {
    const auto surface = static_cast<std::int16_t>(i);
    for (PlanePart& part :
         split_into_parts(camera, cells.columns(), surfaces.planes[i], surfaces.pixels.cells[i],
                          config.part_gap, config.min_pixels)) {
      auto observation = observe(camera, image, surface, part, tolerance, settings);
      if (!observation || !is_wanted(config, observation->surface.plane, up_camera)) continue;
      found.push_back({std::move(*observation), surface, std::move(part)});
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
    return a.observation.inliers > b.observation.inliers;
  });
  return found;
}

std::vector<std::int16_t> label_found(const std::vector<Found>& found, const LabelImage& image) {
  std::vector<std::int16_t> label(image.label.size(), kNoPlane);
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (const PlaneCell* cell : found[i].part) {
      for (int v = cell->box.min().y(); v <= cell->box.max().y(); ++v) {
        for (int u = cell->box.min().x(); u <= cell->box.max().x(); ++u) {
          const auto pixel = static_cast<std::size_t>(v * image.width + u);
          if (image.label[pixel] == found[i].surface) label[pixel] = static_cast<std::int16_t>(i);
        }
      }
    }
  }
  return label;
}

}  // namespace

RansacExtractor::RansacExtractor(RansacExtractorConfig config) : config_(std::move(config)) {
  std::string all;
  for (const std::string& message : config_.validate()) all += (all.empty() ? "" : "; ") + message;
  if (!all.empty()) throw std::invalid_argument("ransac extractor: " + all);
}

ExtractedPlanes RansacExtractor::extract(const geometry::RgbdFrame& frame, std::uint64_t seed,
                                         const std::optional<Eigen::Vector3d>& up_camera) const {
  if (config_.orientation != "any" && !(up_camera && up_camera->norm() > 0.0)) {
    throw std::invalid_argument("plane extraction: an orientation is wanted, but not where up is");
  }
  ExtractedPlanes result;
  if (frame.depth.empty()) return result;
  require_valid(frame);

  const Clock::time_point start = Clock::now();
  const DepthCells cells(frame.depth, frame.depth_camera, config_.min_depth, config_.max_depth);
  const DepthTolerance tolerance = tolerance_of(config_, cells);
  const auto normals = estimate_normals(cells, frame.depth_camera, tolerance);
  const Seeds seeds = find_seeds(config_, frame.depth_camera, cells, normals, tolerance, seed);
  const PixelLabeler labeler(frame, cells, normals, tolerance, config_.min_depth, config_.max_depth,
                             radians(config_.max_normal_angle_deg));
  const Surfaces surfaces = grow_surfaces(config_, frame, cells, tolerance, labeler, seeds);
  result.noise = tolerance.noise;
  result.extraction_seconds = seconds_since(start);

  const Clock::time_point hull_start = Clock::now();
  std::vector<Found> found =
      outline_surfaces(config_, frame, cells, tolerance, surfaces, up_camera);
  result.label = label_found(found, {surfaces.pixels.label, frame.depth.width});
  for (Found& plane : found) result.planes.push_back(std::move(plane.observation));
  result.hull_seconds = seconds_since(hull_start);
  return result;
}

}  // namespace geomap::perception
