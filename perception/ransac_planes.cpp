// SPDX-License-Identifier: BSD-3-Clause
// PCL's templates compiled here, not taken from its library: Eigen objects that own memory go back
// and forth between them and the model below, and Eigen allocates differently under
// AddressSanitizer.
#define PCL_NO_PRECOMPILE
#include "perception/ransac_planes.hpp"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/sample_consensus/ransac.h>
#include <pcl/sample_consensus/sac_model_plane.h>

#include <algorithm>
#include <cmath>

#include "geometry/plane_moments.hpp"

namespace geomap::perception {
namespace {

using PointCloud = pcl::PointCloud<pcl::PointXYZ>;

constexpr int kSampleTries = 40;
constexpr int kRefinements = 4;
// Obliquer surfaces than this take the tolerance of this one: |n·ray|.
constexpr double kLeastCosine = 0.1;

// What the test of a voxel against a plane reads, one array per number so that it vectorises.
struct VoxelTable {
  std::vector<float> x, y, z, nx, ny, nz, tolerance;

  VoxelTable(const VoxelCloud& cloud, const std::vector<int>& indices,
             const DepthTolerance& depth_tolerance) {
    for (auto* column : {&x, &y, &z, &nx, &ny, &nz, &tolerance}) column->reserve(indices.size());
    for (const int i : indices) {
      const Voxel& voxel = cloud.voxels[static_cast<std::size_t>(i)];
      x.push_back(static_cast<float>(voxel.mean.x()));
      y.push_back(static_cast<float>(voxel.mean.y()));
      z.push_back(static_cast<float>(voxel.mean.z()));
      nx.push_back(static_cast<float>(voxel.normal.x()));
      ny.push_back(static_cast<float>(voxel.normal.y()));
      nz.push_back(static_cast<float>(voxel.normal.z()));
      const double range = voxel.mean.z();
      const double cosine = std::max(kLeastCosine, -voxel.normal.dot(voxel.mean) / range);
      tolerance.push_back(static_cast<float>(depth_tolerance.along_ray(range) * cosine +
                                             depth_tolerance.unevenness));
    }
  }

  std::size_t size() const { return x.size(); }

  bool is_inlier(std::size_t i, const Eigen::Vector4f& p, float tolerances, float cosine) const {
    const float distance = std::abs(p[0] * x[i] + p[1] * y[i] + p[2] * z[i] + p[3]);
    const float agreement = std::abs(p[0] * nx[i] + p[1] * ny[i] + p[2] * nz[i]);
    return (distance <= tolerances * tolerance[i]) & (agreement >= cosine);
  }

  void keep(const std::vector<bool>& is_kept) {
    for (auto* column : {&x, &y, &z, &nx, &ny, &nz, &tolerance}) {
      std::size_t kept = 0;
      for (std::size_t i = 0; i < is_kept.size(); ++i) {
        if (is_kept[i]) (*column)[kept++] = (*column)[i];
      }
      column->resize(kept);
    }
  }
};

Eigen::VectorXf to_coefficients(const geometry::Plane& plane) {
  Eigen::VectorXf coefficients(4);
  for (int i = 0; i < 3; ++i) coefficients[i] = static_cast<float>(plane.normal[i]);
  coefficients[3] = static_cast<float>(plane.d);
  return coefficients;
}

// Planes over a VoxelTable; the cloud only tells PCL how many points there are. Thresholds are
// multiples of each voxel's tolerance.
class VoxelPlaneModel : public pcl::SampleConsensusModelPlane<pcl::PointXYZ> {
 public:
  VoxelPlaneModel(const PointCloud::ConstPtr& cloud, const VoxelTable& table,
                  const RansacSettings& settings, std::uint64_t seed)
      : pcl::SampleConsensusModelPlane<pcl::PointXYZ>(cloud),
        table_(table),
        radius_squared_(settings.sample_radius * settings.sample_radius),
        cosine_(static_cast<float>(std::cos(settings.max_normal_angle))) {
    rng_alg_.seed(static_cast<std::uint32_t>(seed ^ (seed >> 32)));
  }

  // Three voxels near each other that could share a plane. Where the first has no two such
  // neighbours it stands alone (three times the same index): its own normal then gives the plane.
  void getSamples(int&, pcl::Indices& samples) override {
    const auto any = [this] { return static_cast<std::size_t>(rnd()) % table_.size(); };
    const std::size_t first = any();
    samples.assign(3, static_cast<pcl::index_t>(first));
    std::size_t found = 1;
    for (int tries = 0; tries < kSampleTries && found < 3; ++tries) {
      const std::size_t next = any();
      if (next != first && next != static_cast<std::size_t>(samples[1]) && may_share(first, next)) {
        samples[found++] = static_cast<pcl::index_t>(next);
      }
    }
    if (found < 3) samples.assign(3, static_cast<pcl::index_t>(first));
  }

  bool computeModelCoefficients(const pcl::Indices& samples,
                                Eigen::VectorXf& coefficients) const override {
    const auto a = static_cast<std::size_t>(samples[0]);
    Eigen::Vector3d normal = normal_of(a);
    if (samples[1] != samples[0]) {
      const Eigen::Vector3d ab = point(static_cast<std::size_t>(samples[1])) - point(a);
      const Eigen::Vector3d ac = point(static_cast<std::size_t>(samples[2])) - point(a);
      const Eigen::Vector3d cross = ab.cross(ac);
      const double length = cross.norm();
      if (length > 0.2 * ab.norm() * ac.norm() && std::abs(cross.dot(normal)) >= cosine_ * length) {
        normal = cross / length;
      }
    }
    coefficients = to_coefficients(geometry::Plane::through(point(a), normal));
    return true;
  }

  std::size_t countWithinDistance(const Eigen::VectorXf& coefficients,
                                  double threshold) const override {
    const Eigen::Vector4f plane = coefficients.head<4>();
    const auto tolerances = static_cast<float>(threshold);
    unsigned count = 0;
    for (std::size_t i = 0; i < table_.size(); ++i) {
      count += table_.is_inlier(i, plane, tolerances, cosine_) ? 1U : 0U;
    }
    return count;
  }

  void selectWithinDistance(const Eigen::VectorXf& coefficients, double threshold,
                            pcl::Indices& inliers) override {
    const Eigen::Vector4f plane = coefficients.head<4>();
    inliers.clear();
    for (std::size_t i = 0; i < table_.size(); ++i) {
      if (table_.is_inlier(i, plane, static_cast<float>(threshold), cosine_)) {
        inliers.push_back(static_cast<pcl::index_t>(i));
      }
    }
  }

 private:
  Eigen::Vector3d point(std::size_t i) const { return {table_.x[i], table_.y[i], table_.z[i]}; }
  Eigen::Vector3d normal_of(std::size_t i) const {
    return {table_.nx[i], table_.ny[i], table_.nz[i]};
  }
  bool may_share(std::size_t a, std::size_t b) const {
    return (point(b) - point(a)).squaredNorm() <= radius_squared_ &&
           normal_of(a).dot(normal_of(b)) >= cosine_;
  }

  const VoxelTable& table_;
  double radius_squared_;
  float cosine_;
};

// Fits the inliers with weights from depth noise and selects again, until the selection stands.
bool refine(const VoxelCloud& cloud, const std::vector<int>& remaining,
            const geometry::DepthNoise& noise, VoxelPlaneModel& model, pcl::Indices& inliers,
            geometry::Plane& plane) {
  for (int round = 0; round < kRefinements; ++round) {
    geometry::PlaneMoments moments;
    Eigen::Vector3d side = Eigen::Vector3d::Zero();
    for (const pcl::index_t i : inliers) {
      const int index = remaining[static_cast<std::size_t>(i)];
      const Voxel& voxel = cloud.voxels[static_cast<std::size_t>(index)];
      moments.add(voxel.mean, noise.sigma(voxel.mean.z()) / std::sqrt(voxel.pixels));
      side -= voxel.mean;
    }
    const auto fit = moments.fit(side);
    if (!fit) return false;
    plane = fit->plane;
    pcl::Indices selected;
    model.selectWithinDistance(to_coefficients(plane), 1.0, selected);
    const bool stands = selected == inliers;
    inliers = std::move(selected);
    if (stands || inliers.size() < 3) break;
  }
  return true;
}

}  // namespace

std::vector<VoxelPlane> ransac_planes(const VoxelCloud& cloud, const std::vector<int>& cluster,
                                      const DepthTolerance& tolerance,
                                      const RansacSettings& settings, std::uint64_t seed) {
  const auto least = static_cast<std::size_t>(std::max(3, settings.least_voxels));
  std::vector<VoxelPlane> planes;
  std::vector<int> remaining = cluster;
  VoxelTable table(cloud, remaining, tolerance);
  const PointCloud::Ptr points(new PointCloud);
  while (remaining.size() >= least) {
    points->resize(remaining.size());
    const auto model = std::make_shared<VoxelPlaneModel>(
        points, table, settings, seed + 0x9e3779b97f4a7c15ULL * (remaining.size() + 1));
    pcl::RandomSampleConsensus<pcl::PointXYZ> ransac(model, 1.0);
    ransac.setMaxIterations(settings.iterations);
    if (!ransac.computeModel()) break;
    pcl::Indices inliers;
    ransac.getInliers(inliers);
    if (inliers.size() < least) break;

    // Whatever the fit does to the selection, what the sample chose is spent: the loop ends.
    std::vector<bool> is_kept(remaining.size(), true);
    for (const pcl::index_t i : inliers) is_kept[static_cast<std::size_t>(i)] = false;
    VoxelPlane found;
    const bool is_fitted = refine(cloud, remaining, tolerance.noise, *model, inliers, found.plane);
    for (const pcl::index_t i : inliers) is_kept[static_cast<std::size_t>(i)] = false;
    if (is_fitted && inliers.size() >= least) {
      for (const pcl::index_t i : inliers) {
        found.voxels.push_back(remaining[static_cast<std::size_t>(i)]);
      }
      planes.push_back(std::move(found));
    }
    table.keep(is_kept);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < is_kept.size(); ++i) {
      if (is_kept[i]) remaining[kept++] = remaining[i];
    }
    remaining.resize(kept);
  }
  return planes;
}

}  // namespace geomap::perception
