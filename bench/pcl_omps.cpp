// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_omps.hpp"

#include <pcl/features/integral_image_normal.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/organized_multi_plane_segmentation.h>

#include <limits>
#include <vector>

#include "geometry/angles.hpp"

namespace geomap::bench {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Normals = pcl::PointCloud<pcl::Normal>;

constexpr float kNormalSmoothing = 20.0F;  // [pixel]
constexpr unsigned kLeastPixels = 1000;
constexpr double kAngle = geometry::radians(3.0);  // between neighbours
constexpr double kDistance = 0.02;                 // [m]

Cloud::Ptr organized_cloud(const geometry::RgbdFrame& frame) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  const geometry::DepthImage& depth = frame.depth;
  const Cloud::Ptr cloud(new Cloud(static_cast<std::uint32_t>(depth.width),
                                   static_cast<std::uint32_t>(depth.height),
                                   pcl::PointXYZ(kNone, kNone, kNone)));
  cloud->is_dense = false;
  for (int v = 0; v < depth.height; ++v) {
    for (int u = 0; u < depth.width; ++u) {
      const std::uint16_t reading = depth.at(u, v);
      if (!geometry::DepthImage::is_reading(reading)) continue;
      cloud->at(u, v).getVector3fMap() =
          frame.depth_camera.point(u, v, 0.001 * reading).cast<float>();
    }
  }
  return cloud;
}

Normals::Ptr normals_of(const Cloud::Ptr& cloud) {
  const Normals::Ptr normals(new Normals);
  pcl::IntegralImageNormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setNormalEstimationMethod(estimation.COVARIANCE_MATRIX);
  estimation.setNormalSmoothingSize(kNormalSmoothing);
  estimation.setInputCloud(cloud);
  estimation.compute(*normals);
  return normals;
}

}  // namespace

std::size_t pcl_organized_planes(const geometry::RgbdFrame& frame) {
  const Cloud::Ptr cloud = organized_cloud(frame);
  pcl::OrganizedMultiPlaneSegmentation<pcl::PointXYZ, pcl::Normal, pcl::Label> segmentation;
  segmentation.setMinInliers(kLeastPixels);
  segmentation.setAngularThreshold(kAngle);
  segmentation.setDistanceThreshold(kDistance);
  segmentation.setInputNormals(normals_of(cloud));
  segmentation.setInputCloud(cloud);
  std::vector<pcl::PlanarRegion<pcl::PointXYZ>,
              Eigen::aligned_allocator<pcl::PlanarRegion<pcl::PointXYZ>>>
      regions;
  segmentation.segmentAndRefine(regions);
  return regions.size();
}

}  // namespace geomap::bench
