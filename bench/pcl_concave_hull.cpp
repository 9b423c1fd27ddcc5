// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/surface/concave_hull.h>

#include "plane_hulls.hpp"

namespace geomap::bench {

std::size_t pcl_concave_hull(const std::vector<Eigen::Vector2d>& points, double alpha) {
  using Cloud = pcl::PointCloud<pcl::PointXYZ>;
  const Cloud::Ptr cloud(new Cloud);
  cloud->reserve(points.size());
  for (const Eigen::Vector2d& p : points) {
    cloud->push_back(pcl::PointXYZ(static_cast<float>(p.x()), static_cast<float>(p.y()), 0.0F));
  }
  Cloud hull;
  pcl::ConcaveHull<pcl::PointXYZ> concave;
  concave.setInputCloud(cloud);
  concave.setAlpha(alpha);
  concave.setDimension(2);
  concave.reconstruct(hull);
  return hull.size();
}

}  // namespace geomap::bench
