// SPDX-License-Identifier: BSD-3-Clause
#include "perception/euclidean_clusters.hpp"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>

#include <algorithm>

namespace geomap::perception {

std::vector<std::vector<int>> euclidean_clusters(const VoxelCloud& cloud, double tolerance,
                                                 double reference, int least) {
  if (cloud.voxels.empty()) return {};
  pcl::PointCloud<pcl::PointXYZ>::Ptr points(new pcl::PointCloud<pcl::PointXYZ>);
  points->reserve(cloud.voxels.size());
  for (const Voxel& voxel : cloud.voxels) {
    const Eigen::Vector3f p = evenly_dense(voxel.mean, reference).cast<float>();
    points->push_back(pcl::PointXYZ(p.x(), p.y(), p.z()));
  }
  const pcl::search::KdTree<pcl::PointXYZ>::Ptr tree(
      new pcl::search::KdTree<pcl::PointXYZ>(/*sorted=*/false));
  tree->setInputCloud(points);

  std::vector<pcl::PointIndices> found;
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setClusterTolerance(tolerance);
  extraction.setMinClusterSize(static_cast<pcl::uindex_t>(std::max(1, least)));
  extraction.setSearchMethod(tree);
  extraction.setInputCloud(points);
  extraction.extract(found);

  std::vector<std::vector<int>> clusters;
  clusters.reserve(found.size());
  for (const pcl::PointIndices& indices : found) {
    clusters.emplace_back(indices.indices.begin(), indices.indices.end());
    std::sort(clusters.back().begin(), clusters.back().end());
  }
  std::sort(clusters.begin(), clusters.end(), [](const auto& a, const auto& b) {
    return a.size() != b.size() ? a.size() > b.size() : a.front() < b.front();
  });
  return clusters;
}

}  // namespace geomap::perception
