// SPDX-License-Identifier: BSD-3-Clause
#include "perception/ransac_extractor.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "geometry/angles.hpp"
#include "geometry/polygon_simplify.hpp"
#include "perception/euclidean_clusters.hpp"
#include "perception/part_outline.hpp"
#include "perception/pixel_labels.hpp"
#include "perception/plane_observation.hpp"
#include "perception/plane_parts.hpp"
#include "perception/plane_pixels.hpp"
#include "perception/plane_rays.hpp"
#include "perception/ransac_planes.hpp"
#include "perception/surface_region.hpp"
#include "perception/voxel_cloud.hpp"

namespace geomap::perception {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

using geometry::radians;

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

// Paper: voxel filter, Euclidean clusters, RANSAC. Fitted to their cells, not voxels, and joined
// where RANSAC cut one surface in two.
CellRegions find_regions(const RansacExtractorConfig& config, const geometry::CameraModel& camera,
                         const DepthCells& cells, const std::vector<CellNormal>& normals,
                         const DepthTolerance& tolerance, std::uint64_t seed) {
  const double reference = even_density_depth(config, camera);
  const VoxelCloud cloud = make_voxel_cloud(cells, normals, config.voxel_size, reference);
  const std::vector<VoxelPlane> found = find_planes(config, cloud, reference, tolerance, seed);
  std::vector<std::int16_t> label = label_cells(cloud, found);
  std::vector<SurfaceRegion> regions(found.size());
  for (int i = 0; i < cells.size(); ++i) {
    if (label[static_cast<std::size_t>(i)] == kNoPlane) continue;
    SurfaceRegion& region = regions[static_cast<std::size_t>(label[static_cast<std::size_t>(i)])];
    region.cells.push_back(i);
    region.sums += cells.cell(i);
  }
  for (SurfaceRegion& region : regions) region.fit();
  return merge_regions(cells, normals, cell_means(cells, tolerance), tolerance,
                       radians(config.max_normal_angle_deg), radians(config.max_merge_angle_deg),
                       std::move(regions), std::move(label));
}

// Paper: clustering of the inliers, concave hull.
std::vector<FoundPart> outline_surfaces(const RansacExtractorConfig& config,
                                        const geometry::RgbdFrame& frame, const DepthCells& cells,
                                        const DepthTolerance& tolerance,
                                        const std::vector<geometry::Plane>& planes,
                                        const PlanePixels& pixels,
                                        const std::optional<Eigen::Vector3d>& up_camera) {
  const geometry::CameraModel& camera = frame.depth_camera;
  const LabelImage image{pixels.label, frame.depth.width};
  std::vector<FoundPart> found =
      find_parts(config, frame, cells, tolerance, planes, pixels, up_camera);
  std::erase_if(found, [&](FoundPart& f) {
    geometry::PlanarPolygon& surface = f.observation.surface;
    const Eigen::Vector2d centre = camera.project(surface.frame.origin);
    surface.polygon = geometry::simplify(
        part_outline(camera, surface.plane, surface.frame, image, f.surface, f.part, config.alpha),
        config.simplify_tolerance + pixel_length(camera, surface.plane, centre));
    return !covers_enough(camera, f.observation, f.part, config);
  });
  return found;
}

}  // namespace

RansacExtractor::RansacExtractor(RansacExtractorConfig config) : config_(std::move(config)) {
  require_no_faults("ransac extractor", config_.validate());
}

ExtractedPlanes RansacExtractor::extract(const geometry::RgbdFrame& frame, std::uint64_t seed,
                                         const std::optional<Eigen::Vector3d>& up_camera) const {
  config_.require_valid(frame, up_camera);
  ExtractedPlanes result;
  if (frame.depth.empty()) return result;

  const Clock::time_point start = Clock::now();
  const DepthCells cells(frame.depth, frame.depth_camera, config_.min_depth, config_.max_depth);
  const DepthTolerance tolerance = config_.tolerance_of(cells);
  const auto normals = estimate_normals(cells, frame.depth_camera, tolerance);
  const CellRegions regions =
      find_regions(config_, frame.depth_camera, cells, normals, tolerance, seed);
  const PixelLabeler labeler(frame, cells, normals, tolerance, config_.min_depth, config_.max_depth,
                             radians(config_.max_normal_angle_deg));
  const PlanePixels pixels = collect_pixels(
      frame, cells, labeler.label(regions.planes, regions.cell_label), regions.planes.size());
  result.noise = tolerance.noise;
  result.extraction_seconds = seconds_since(start);

  const Clock::time_point hull_start = Clock::now();
  std::vector<FoundPart> found =
      outline_surfaces(config_, frame, cells, tolerance, regions.planes, pixels, up_camera);
  result.label = label_parts(found, pixels.label, frame.depth.width);
  for (FoundPart& plane : found) result.planes.push_back(std::move(plane.observation));
  result.hull_seconds = seconds_since(hull_start);
  return result;
}

}  // namespace geomap::perception
