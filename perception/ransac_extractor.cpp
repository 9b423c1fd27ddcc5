// SPDX-License-Identifier: BSD-3-Clause
#include "perception/ransac_extractor.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "perception/euclidean_clusters.hpp"
#include "perception/merge_planes.hpp"
#include "perception/noise_estimate.hpp"
#include "perception/plane_observation.hpp"
#include "perception/plane_parts.hpp"
#include "perception/plane_pixels.hpp"
#include "perception/ransac_planes.hpp"
#include "perception/voxel_cloud.hpp"

namespace geomap::perception {
namespace {

// The first assignment of pixels only has to be good enough to fit and merge planes.
constexpr int kFirstRowStep = 2;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

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

// The depth beyond which voxels and cluster tolerance grow: cells are not denser there than this share
// of a voxel (2.5 m for a Kinect and 4 cm).
double even_density_depth(const RansacExtractorConfig& config, const geometry::CameraModel& camera) {
  constexpr double kCellsOfVoxel = 0.43;
  return kCellsOfVoxel * config.voxel_size * std::min(camera.fx, camera.fy) / DepthCells::kSide;
}

std::vector<VoxelPlane> find_planes(const RansacExtractorConfig& config, const VoxelCloud& cloud,
                                    double reference, const DepthTolerance& tolerance,
                                    std::uint64_t seed) {
  RansacSettings settings;
  settings.iterations = config.ransac_iterations;
  settings.least_voxels = config.min_cluster_voxels;
  settings.max_normal_angle = radians(config.max_normal_angle_deg);
  std::vector<VoxelPlane> planes;
  for (const std::vector<int>& cluster :
       euclidean_clusters(cloud, config.cluster_tolerance, reference,
                          config.min_cluster_voxels)) {
    for (VoxelPlane& plane : ransac_planes(cloud, cluster, tolerance, settings, seed++)) {
      planes.push_back(std::move(plane));
    }
  }
  return planes;
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
  result.noise = tolerance.noise;
  const auto normals = estimate_normals(cells, frame.depth_camera, tolerance);
  const double reference = even_density_depth(config_, frame.depth_camera);
  const VoxelCloud cloud = make_voxel_cloud(cells, normals, config_.voxel_size, reference);
  const std::vector<VoxelPlane> found = find_planes(config_, cloud, reference, tolerance, seed);

  const PixelAssigner assigner(frame, cells, normals, tolerance, config_.min_depth,
                               config_.max_depth, radians(config_.max_normal_angle_deg));
  std::vector<geometry::Plane> planes;
  for (const VoxelPlane& plane : found) planes.push_back(plane.plane);
  const FittedPlanes fitted =
      fit_and_merge(cells, assigner.assign(planes, label_cells(cloud, found), kFirstRowStep), tolerance,
                    radians(config_.max_merge_angle_deg), kFirstRowStep);
  const PlanePixels pixels = assigner.assign(fitted.planes, fitted.cell_label);
  result.extraction_seconds = seconds_since(start);

  const Clock::time_point hull_start = Clock::now();
  const LabelImage image{pixels.label, frame.depth.width};
  const ObservationSettings settings = observation_settings(config_);
  for (std::size_t i = 0; i < fitted.planes.size(); ++i) {
    for (const PlanePart& part :
         split_into_parts(frame.depth_camera, cells.columns(), fitted.planes[i], pixels.cells[i],
                          config_.part_gap, config_.min_pixels)) {
      auto observation = observe(frame.depth_camera, image, static_cast<std::int16_t>(i), part,
                                 tolerance, settings);
      if (observation && is_wanted(config_, observation->surface.plane, up_camera)) {
        result.planes.push_back(std::move(*observation));
      }
    }
  }
  std::stable_sort(result.planes.begin(), result.planes.end(),
                   [](const auto& a, const auto& b) { return a.inliers > b.inliers; });
  result.hull_seconds = seconds_since(hull_start);
  return result;
}

}  // namespace geomap::perception
