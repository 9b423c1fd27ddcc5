// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_recipe.hpp"

#include <pcl/ModelCoefficients.h>
#include <pcl/filters/extract_indices.h>
#include <pcl/filters/project_inliers.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>
#include <pcl/segmentation/sac_segmentation.h>
#include <pcl/surface/concave_hull.h>

#include <vector>

namespace geomap::bench {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

constexpr int kIterations = 100;

Cloud::Ptr deproject(const geometry::RgbdFrame& frame) {
  const Cloud::Ptr cloud(new Cloud);
  const geometry::CameraModel& camera = frame.depth_camera;
  cloud->reserve(frame.depth.millimetres.size());
  for (int v = 0; v < frame.depth.height; ++v) {
    for (int u = 0; u < frame.depth.width; ++u) {
      const std::uint16_t reading = frame.depth.at(u, v);
      if (!geometry::DepthImage::is_reading(reading)) continue;
      const Eigen::Vector3d p = camera.point(u, v, 0.001 * reading);
      cloud->push_back(pcl::PointXYZ(static_cast<float>(p.x()), static_cast<float>(p.y()),
                                     static_cast<float>(p.z())));
    }
  }
  return cloud;
}

Cloud::Ptr thin(const Cloud::Ptr& cloud, float leaf) {
  const Cloud::Ptr thinned(new Cloud);
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  grid.setInputCloud(cloud);
  grid.setLeafSize(leaf, leaf, leaf);
  grid.filter(*thinned);
  return thinned;
}

std::vector<pcl::PointIndices> clusters_of(const Cloud::Ptr& cloud,
                                           const PclRecipeSettings& settings) {
  const pcl::search::KdTree<pcl::PointXYZ>::Ptr tree(new pcl::search::KdTree<pcl::PointXYZ>);
  tree->setInputCloud(cloud);
  std::vector<pcl::PointIndices> clusters;
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setClusterTolerance(settings.cluster_tolerance);
  extraction.setMinClusterSize(settings.least_points);
  extraction.setSearchMethod(tree);
  extraction.setInputCloud(cloud);
  extraction.extract(clusters);
  return clusters;
}

Cloud::Ptr part_of(const Cloud::Ptr& cloud, const pcl::PointIndices& indices, bool is_negative) {
  const Cloud::Ptr part(new Cloud);
  pcl::ExtractIndices<pcl::PointXYZ> extraction;
  extraction.setInputCloud(cloud);
  extraction.setIndices(pcl::PointIndices::Ptr(new pcl::PointIndices(indices)));
  extraction.setNegative(is_negative);
  extraction.filter(*part);
  return part;
}

void add_hulls(const Cloud::Ptr& inliers, const pcl::ModelCoefficients& plane,
               const PclRecipeSettings& settings, PclRecipeResult& result) {
  const Cloud::Ptr projected(new Cloud);
  pcl::ProjectInliers<pcl::PointXYZ> projection;
  projection.setModelType(pcl::SACMODEL_PLANE);
  projection.setInputCloud(inliers);
  projection.setModelCoefficients(pcl::ModelCoefficients::Ptr(new pcl::ModelCoefficients(plane)));
  projection.filter(*projected);
  for (const pcl::PointIndices& part : clusters_of(projected, settings)) {
    Cloud hull;
    pcl::ConcaveHull<pcl::PointXYZ> concave;
    concave.setInputCloud(part_of(projected, part, false));
    concave.setAlpha(settings.alpha);
    concave.setDimension(2);
    concave.reconstruct(hull);
    ++result.planes;
    result.vertices += hull.size();
  }
}

}  // namespace

PclRecipeResult pcl_recipe(const geometry::RgbdFrame& frame, const PclRecipeSettings& settings) {
  const auto least_points = static_cast<std::size_t>(settings.least_points);
  PclRecipeResult result;
  const Cloud::Ptr cloud = thin(deproject(frame), settings.leaf);
  for (const pcl::PointIndices& cluster : clusters_of(cloud, settings)) {
    Cloud::Ptr remaining = part_of(cloud, cluster, false);
    while (remaining->size() >= least_points) {
      pcl::SACSegmentation<pcl::PointXYZ> segmentation;
      segmentation.setModelType(pcl::SACMODEL_PLANE);
      segmentation.setMethodType(pcl::SAC_RANSAC);
      segmentation.setOptimizeCoefficients(true);
      segmentation.setMaxIterations(kIterations);
      segmentation.setDistanceThreshold(settings.plane_threshold);
      segmentation.setInputCloud(remaining);
      pcl::PointIndices inliers;
      pcl::ModelCoefficients plane;
      segmentation.segment(inliers, plane);
      if (inliers.indices.size() < least_points) break;
      add_hulls(part_of(remaining, inliers, false), plane, settings, result);
      remaining = part_of(remaining, inliers, true);
    }
  }
  return result;
}

}  // namespace geomap::bench
