// SPDX-License-Identifier: BSD-3-Clause
#include "perception/ransac_planes.hpp"

#include <numeric>
#include <random>

namespace geomap::perception {
namespace {

using Eigen::Vector3d;

// Voxels every 4 cm on a square of 1 m, `normal` towards the camera at the origin.
void add_square(VoxelCloud& cloud, const Vector3d& corner, const Vector3d& u, const Vector3d& v) {
  Vector3d normal = u.cross(v).normalized();
  if (normal.dot(corner) > 0.0) normal = -normal;
  for (int i = 0; i <= 25; ++i) {
    for (int j = 0; j <= 25; ++j) {
      cloud.voxels.push_back({corner + 0.04 * i * u + 0.04 * j * v, normal, 20.0});
    }
  }
}

std::vector<int> all_of(const VoxelCloud& cloud) {
  std::vector<int> indices(cloud.voxels.size());
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

DepthTolerance coarse() {
  DepthTolerance tolerance;
  tolerance.noise.factor = 2.0;  // ±6 cm at 2.5 m
  return tolerance;
}

TEST(RansacPlanes, APlaneTakesNoStripOfASurfaceThatCrossesIt) {
  VoxelCloud cloud;  // a floor, and a wall standing in its middle
  add_square(cloud, {-0.5, 0.5, 2.0}, Vector3d::UnitX(), Vector3d::UnitZ());
  const auto of_floor = cloud.voxels.size();
  add_square(cloud, {-0.5, 0.0, 2.5}, Vector3d::UnitX(), Vector3d::UnitY());
  const auto planes = ransac_planes(cloud, all_of(cloud), coarse(), {}, 1);
  ASSERT_EQ(planes.size(), 2u);
  for (const VoxelPlane& plane : planes) {
    ASSERT_EQ(plane.voxels.size(), of_floor);
    const bool is_floor = plane.voxels.front() == 0;
    for (const int voxel : plane.voxels) {
      EXPECT_EQ(static_cast<std::size_t>(voxel) < of_floor, is_floor);
    }
    const Vector3d expected = is_floor ? -Vector3d::UnitY() : -Vector3d::UnitZ();
    EXPECT_GT(plane.plane.normal.dot(expected), 1.0 - 1e-9);
  }
}

TEST(RansacPlanes, ToleranceGrowsWithTheRange) {
  // Two steps of 5 cm: at 1 m it is far above the noise, at 4 m within it.
  for (const double z : {1.0, 4.0}) {
    VoxelCloud cloud;
    add_square(cloud, {-1.0, -0.5, z}, Vector3d::UnitX(), Vector3d::UnitY());
    add_square(cloud, {0.04, -0.5, z + 0.05}, Vector3d::UnitX(), Vector3d::UnitY());
    const auto planes = ransac_planes(cloud, all_of(cloud), DepthTolerance{}, {}, 1);
    EXPECT_EQ(planes.size(), z < 2.0 ? 2u : 1u) << z;
  }
}

// Random points with random normals: whatever planes are found depends on the draws.
std::vector<VoxelPlane> planes_in_clutter(std::uint64_t seed) {
  std::mt19937 generator(4);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  VoxelCloud cloud;
  for (int i = 0; i < 600; ++i) {
    const Vector3d at(uniform(generator), uniform(generator), 2.0 + uniform(generator));
    const Vector3d normal = Vector3d(uniform(generator), uniform(generator), -0.7).normalized();
    cloud.voxels.push_back({at, normal, 10.0});
  }
  return ransac_planes(cloud, all_of(cloud), coarse(), {}, seed);
}

bool equal(const std::vector<VoxelPlane>& a, const std::vector<VoxelPlane>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& p, const auto& q) {
    return p.plane.normal == q.plane.normal && p.plane.d == q.plane.d && p.voxels == q.voxels;
  });
}

TEST(RansacPlanes, TheSeedAloneDecidesWhatIsDrawn) {
  const auto first = planes_in_clutter(5);
  EXPECT_FALSE(first.empty());
  EXPECT_TRUE(equal(first, planes_in_clutter(5)));
  EXPECT_FALSE(equal(first, planes_in_clutter(6)));
}

TEST(RansacPlanes, TooFewVoxelsAreNoPlane) {
  VoxelCloud cloud;
  EXPECT_TRUE(ransac_planes(cloud, {}, coarse(), {}, 1).empty());
  for (int i = 0; i < 7; ++i) {
    cloud.voxels.push_back({{0.04 * (i % 3), 0.04 * (i / 3), 1.0}, -Vector3d::UnitZ(), 20.0});
  }
  EXPECT_TRUE(ransac_planes(cloud, all_of(cloud), coarse(), {}, 1).empty());
}

TEST(RansacPlanes, VoxelsOnALineEndTheSearch) {
  VoxelCloud cloud;
  for (int i = 0; i < 40; ++i) {
    cloud.voxels.push_back({{0.04 * i, 0.0, 1.0}, -Vector3d::UnitZ(), 20.0});
  }
  EXPECT_TRUE(ransac_planes(cloud, all_of(cloud), coarse(), {}, 1).empty());
}

}  // namespace
}  // namespace geomap::perception
