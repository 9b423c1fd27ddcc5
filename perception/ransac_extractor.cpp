// SPDX-License-Identifier: BSD-3-Clause
#include "perception/ransac_extractor.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/angles.hpp"
#include "geometry/polygon_simplify.hpp"
#include "perception/euclidean_clusters.hpp"
#include "perception/extract_surfaces.hpp"
#include "perception/part_outline.hpp"
#include "perception/plane_rays.hpp"
#include "perception/ransac_planes.hpp"
#include "perception/surface_region.hpp"
#include "perception/voxel_cloud.hpp"

namespace geomap::perception {
namespace {

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

// Paper: concave hull.
void outline(const RansacExtractorConfig& config, const geometry::RgbdFrame& frame,
             const PlanePixels& pixels, std::vector<FoundPart>& found) {
  const geometry::CameraModel& camera = frame.depth_camera;
  const LabelImage image{pixels.label, frame.depth.width};
  for (FoundPart& f : found) {
    geometry::PlanarPolygon& surface = f.observation.surface;
    const Eigen::Vector2d centre = camera.project(surface.frame.origin);
    surface.polygon = geometry::simplify(
        part_outline(camera, surface.plane, surface.frame, image, f.surface, f.part, config.alpha),
        config.simplify_tolerance + pixel_length(camera, surface.plane, centre));
  }
}

}  // namespace

RansacExtractor::RansacExtractor(RansacExtractorConfig config) : config_(std::move(config)) {
  require_no_faults("ransac extractor", config_.validate());
}

ExtractedPlanes RansacExtractor::extract(const geometry::RgbdFrame& frame, std::uint64_t seed,
                                         const std::optional<Eigen::Vector3d>& up_camera) const {
  ExtractionSteps steps;
  steps.max_normal_angle = [this](const DepthTolerance&) {
    return radians(config_.max_normal_angle_deg);
  };
  steps.find_regions = [&](const DepthCells& cells, const std::vector<CellNormal>& normals,
                           const DepthTolerance& tolerance) {
    return find_regions(config_, frame.depth_camera, cells, normals, tolerance, seed);
  };
  steps.outline = [&](const PlanePixels& pixels, std::vector<FoundPart>& found,
                      std::vector<std::int16_t>&) { outline(config_, frame, pixels, found); };
  return extract_surfaces(config_, frame, up_camera, steps);
}

}  // namespace geomap::perception
