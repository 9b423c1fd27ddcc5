// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_registration.hpp"

#include <pcl/features/normal_3d.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/registration/gicp.h>
#include <pcl/registration/icp.h>
#include <pcl/search/kdtree.h>

namespace geomap::bench {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using NormalCloud = pcl::PointCloud<pcl::PointNormal>;

constexpr float kLeaf = 0.05F;         // [m]
constexpr double kFarthestPair = 0.2;  // [m]
constexpr int kNormalNeighbours = 12;  // on 5 cm voxels: about 10 cm around
constexpr int kIterations = 50;        // of both ICP; GICP keeps PCL's own criteria
constexpr double kConverged = 1e-8;    // squared step of both ICP [m²]

Cloud::Ptr deproject(const geometry::RgbdFrame& frame) {
  const Cloud::Ptr cloud(new Cloud);
  const geometry::CameraModel& camera = frame.depth_camera;
  const auto fx = static_cast<float>(1e-3 / camera.fx), fy = static_cast<float>(1e-3 / camera.fy);
  const auto cx = static_cast<float>(camera.cx), cy = static_cast<float>(camera.cy);
  cloud->resize(frame.depth.millimetres.size());
  std::size_t size = 0;
  for (int v = 0; v < frame.depth.height; ++v) {
    const float y = fy * (static_cast<float>(v) - cy);
    for (int u = 0; u < frame.depth.width; ++u) {
      const std::uint16_t reading = frame.depth.at(u, v);
      if (!geometry::DepthImage::is_reading(reading)) continue;
      const float z = reading;
      (*cloud)[size++] = pcl::PointXYZ(fx * (static_cast<float>(u) - cx) * z, y * z, 1e-3F * z);
    }
  }
  cloud->resize(size);
  return cloud;
}

Cloud::Ptr thin(const Cloud::Ptr& cloud) {
  const Cloud::Ptr thinned(new Cloud);
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  grid.setInputCloud(cloud);
  grid.setLeafSize(kLeaf, kLeaf, kLeaf);
  grid.filter(*thinned);
  return thinned;
}

template <typename Point>
typename pcl::search::KdTree<Point>::Ptr tree_of(
    const typename pcl::PointCloud<Point>::Ptr& cloud) {
  const typename pcl::search::KdTree<Point>::Ptr tree(new pcl::search::KdTree<Point>);
  tree->setInputCloud(cloud);
  return tree;
}

// Opens what PCL's class does inside of align(), so that a frame's covariances are made once.
class Gicp : public pcl::GeneralizedIterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> {
 public:
  MatricesVectorPtr covariances_of(const Cloud::ConstPtr& cloud,
                                   const pcl::search::KdTree<pcl::PointXYZ>::Ptr& tree) {
    MatricesVectorPtr covariances(new MatricesVector);
    computeCovariances<pcl::PointXYZ>(cloud, tree, *covariances);
    return covariances;
  }
};

NormalCloud::Ptr with_normals(const Cloud::Ptr& cloud,
                              const pcl::search::KdTree<pcl::PointXYZ>::Ptr& tree) {
  const NormalCloud::Ptr result(new NormalCloud);
  pcl::copyPointCloud(*cloud, *result);
  pcl::NormalEstimation<pcl::PointXYZ, pcl::PointNormal> estimation;
  estimation.setInputCloud(cloud);
  estimation.setSearchMethod(tree);
  estimation.setKSearch(kNormalNeighbours);
  NormalCloud normals;
  estimation.compute(normals);
  for (std::size_t i = 0; i < result->size(); ++i) {
    (*result)[i].getNormalVector3fMap() = normals[i].getNormalVector3fMap();
  }
  return result;
}

// Trees are made already: PCL shall not make them once more.
template <typename Method, typename Points, typename Tree>
void set_pair(Method& method, const Points& source, const Tree& source_tree, const Points& target,
              const Tree& target_tree) {
  method.setInputSource(source);
  method.setInputTarget(target);
  method.setSearchMethodSource(source_tree, true);
  method.setSearchMethodTarget(target_tree, true);
}

template <typename Method>
std::optional<Eigen::Isometry3d> run(Method& method, const Eigen::Isometry3d& guess) {
  method.setMaxCorrespondenceDistance(kFarthestPair);
  typename Method::PointCloudSource moved;
  method.align(moved, guess.matrix().cast<float>());
  if (!method.hasConverged()) return std::nullopt;
  const Eigen::Matrix4d found = method.getFinalTransformation().template cast<double>();
  const Eigen::Matrix3d rotation = found.topLeftCorner<3, 3>();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
  T.translation() = found.topRightCorner<3, 1>();
  return T;
}

}  // namespace

struct PclFrame::Prepared {
  Cloud::Ptr cloud;
  pcl::search::KdTree<pcl::PointXYZ>::Ptr tree;
  NormalCloud::Ptr normals;
  pcl::search::KdTree<pcl::PointNormal>::Ptr normals_tree;
  Gicp::MatricesVectorPtr covariances;
};

PclFrame::PclFrame(const geometry::RgbdFrame& frame, PclMethod method) : method_(method) {
  const auto prepared = std::make_shared<Prepared>();
  prepared->cloud = thin(deproject(frame));
  prepared->tree = tree_of<pcl::PointXYZ>(prepared->cloud);
  if (method == PclMethod::kGicp) {
    prepared->covariances = Gicp().covariances_of(prepared->cloud, prepared->tree);
  } else if (method == PclMethod::kPointToPlane) {
    prepared->normals = with_normals(prepared->cloud, prepared->tree);
    prepared->normals_tree = tree_of<pcl::PointNormal>(prepared->normals);
  }
  prepared_ = prepared;
}

std::optional<Eigen::Isometry3d> pcl_align(const PclFrame& source, const PclFrame& target,
                                           const Eigen::Isometry3d& T_target_source_guess) {
  const PclFrame::Prepared &from = source.prepared(), &onto = target.prepared();
  const auto set_criteria = [](auto& icp) {
    icp.setMaximumIterations(kIterations);
    icp.setTransformationEpsilon(kConverged);
  };
  if (source.method() == PclMethod::kPointToPlane) {
    pcl::IterativeClosestPointWithNormals<pcl::PointNormal, pcl::PointNormal> icp;
    set_criteria(icp);
    set_pair(icp, from.normals, from.normals_tree, onto.normals, onto.normals_tree);
    return run(icp, T_target_source_guess);
  }
  if (source.method() == PclMethod::kPointToPoint) {
    pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> icp;
    set_criteria(icp);
    set_pair(icp, from.cloud, from.tree, onto.cloud, onto.tree);
    return run(icp, T_target_source_guess);
  }
  Gicp gicp;
  set_pair(gicp, from.cloud, from.tree, onto.cloud, onto.tree);
  gicp.setSourceCovariances(from.covariances);
  gicp.setTargetCovariances(onto.covariances);
  return run(gicp, T_target_source_guess);
}

}  // namespace geomap::bench
