// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "perception/point_map.hpp"
#include "registration_scenes.hpp"

namespace geomap::perception {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using geometry::Frustum;

Frustum frustum_at(const Isometry3d& T_world_camera, double far = 4.0) {
  return {testing::kinect_camera(), 0.1, far, T_world_camera};
}

std::vector<Isometry3d> cameras() {
  return {testing::look_at({0.9, -1.1, 1.4}, {-0.5, 1.2, 0.6}),
          testing::look_at({-1.0, -1.2, 1.2}, {0.4, 1.5, 0.7}),
          testing::look_at({0.0, 0.2, 1.6}, {-1.8, 0.5, 0.3}),
          testing::look_at({0.1, 0.3, 1.5}, {0.3, 1.0, 0.1})};
}

/// @brief The small room, seen by all cameras, and moved as a whole.
void add_room(VoxelMap& map, const Vector3d& offset = Vector3d::Zero()) {
  for (const Isometry3d& T : cameras()) {
    const auto frame =
        testing::render(testing::small_room(), testing::kinect_camera(7), T, 0.002).frame;
    const SurfaceImage surfaces(frame, 0.4, 5.0);
    map.insert(frame, Eigen::Translation3d(offset) * T, &surfaces);
  }
}

/// A box around everything, as a camera with a wide view from far away sees it.
std::vector<Surfel> all_surfels(const VoxelMap& map) {
  return map
      .surfels_in({{100, 100, 20.0, 20.0, 50.0, 50.0},
                   0.1,
                   30.0,
                   testing::look_at({0.0, -15.0, 1.0}, {0.0, 0.0, 1.0})})
      .surfels;
}

Eigen::AlignedBox3d block_box_of(const VoxelMap& map, const Vector3d& p) {
  const double side = 8 * VoxelMapConfig().voxel_size;
  const Vector3d index = (p / side).array().floor();
  return map.block_box({static_cast<std::int32_t>(index.x()), static_cast<std::int32_t>(index.y()),
                        static_cast<std::int32_t>(index.z())});
}

void expect_same(const std::vector<Surfel>& a, const std::vector<Surfel>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].position, b[i].position);
    EXPECT_EQ(a[i].normal, b[i].normal);
  }
}

TEST(SurfelSelection, IsWhatBruteForceFindsInTheWholeMap) {
  VoxelMap map;
  add_room(map);
  const std::vector<Surfel> all = all_surfels(map);
  ASSERT_GT(all.size(), 5000U);
  for (const Isometry3d& T : cameras()) {
    const Frustum frustum = frustum_at(T, 2.5);
    Eigen::AlignedBox3d around;
    for (const Vector3d& corner : frustum.corners()) around.extend(corner);
    std::vector<Surfel> expected;
    std::copy_if(all.begin(), all.end(), std::back_inserter(expected), [&](const Surfel& surfel) {
      const Eigen::AlignedBox3d box = block_box_of(map, surfel.position);
      return frustum.may_intersect(box) && around.intersects(box);
    });
    ASSERT_LT(expected.size(), all.size());
    ASSERT_GT(expected.size(), 500U);
    expect_same(map.surfels_in(frustum).surfels, expected);
  }
}

TEST(SurfelSelection, HoldsEverySurfelInsideTheFrustum) {
  VoxelMap map;
  add_room(map);
  const std::vector<Surfel> all = all_surfels(map);
  for (const Isometry3d& T : cameras()) {
    const Frustum frustum = frustum_at(T, 2.5);
    const auto count = [&](const std::vector<Surfel>& surfels) {
      return std::count_if(surfels.begin(), surfels.end(),
                           [&](const Surfel& s) { return frustum.contains(s.position); });
    };
    EXPECT_EQ(count(map.surfels_in(frustum).surfels), count(all));
  }
}

TEST(SurfelSelection, PositionsAreTheVoxelsMeansAndNormalsThoseOfTheSurfaces) {
  VoxelMap map;
  add_room(map);
  const auto planes = testing::small_room();
  int near_a_plane = 0;
  const std::vector<Surfel> all = all_surfels(map);
  for (const Surfel& surfel : all) {
    const auto point = map.at(surfel.position);
    ASSERT_TRUE(point);
    EXPECT_LT((point->position - surfel.position).norm(), 1e-12);
    EXPECT_NEAR(surfel.normal.norm(), 1.0, 1e-12);
    near_a_plane += std::any_of(planes.begin(), planes.end(), [&](const testing::Rectangle& r) {
      const geometry::Plane plane = r.plane_seen_from({0.5, -0.5, 1.5});
      return std::abs(plane.signed_distance(surfel.position)) < 0.01 &&
             plane.normal.dot(surfel.normal) > 0.9;
    });
  }
  EXPECT_GT(near_a_plane, 0.97 * static_cast<double>(all.size()));
}

TEST(SurfelSelection, CostsWhatTheViewCostsNotWhatTheMapHolds) {
  VoxelMap room, city;
  add_room(room);
  for (int x = 0; x < 10; ++x) {
    for (int y = 0; y < 10; ++y) {
      // Whole blocks apart, so that the room itself lies in the same voxels.
      const Vector3d offset = 0.32 * Vector3d(20.0 * (x - 5), 20.0 * (y - 5), 0.0);
      add_room(city, offset);
    }
  }
  ASSERT_GT(city.size(), 95 * room.size());
  for (const Isometry3d& T : cameras()) {
    const SurfelSelection in_room = room.surfels_in(frustum_at(T));
    const SurfelSelection in_city = city.surfels_in(frustum_at(T));
    EXPECT_NEAR(in_city.blocks_visited, in_room.blocks_visited, 0.05 * in_room.blocks_visited);
    EXPECT_NEAR(in_city.blocks_used, in_room.blocks_used, 0.05 * in_room.blocks_used);
    expect_same(in_city.surfels, in_room.surfels);
  }
}

TEST(SurfelSelection, IsEmptyWhereTheMapIsAndWhereTheWorldEnds) {
  VoxelMap map;
  EXPECT_TRUE(map.surfels_in(frustum_at(cameras()[0])).surfels.empty());
  add_room(map);
  for (const double far : {100.0, 9e5, 1e7, 1e300}) {
    const Isometry3d T = Eigen::Translation3d(far, 0.0, 0.0) * cameras()[0];
    const SurfelSelection selection = map.surfels_in(frustum_at(T));
    EXPECT_TRUE(selection.surfels.empty());
    EXPECT_EQ(selection.blocks_used, 0);
  }
}

TEST(SurfelSelection, ReadingsWithoutSurfacesGiveNoSurfels) {
  VoxelMap map;
  const Isometry3d T = cameras()[0];
  map.insert(testing::render(testing::small_room(), testing::kinect_camera(7), T).frame, T);
  const SurfelSelection selection = map.surfels_in(frustum_at(T));
  EXPECT_GT(selection.blocks_used, 20);
  EXPECT_TRUE(selection.surfels.empty());
}

TEST(SurfelSelection, TheTwoSidesOfAThinWallGiveNoFalseNormal) {
  // Seen once from either side, a voxel's normals cancel: no surfel rather than a wrong one.
  const testing::Rectangle wall{
      "wall", {0.0, 2.02, 1.0}, Vector3d::UnitX(), Vector3d::UnitZ(), 3.0, 3.0, {}, {}};
  VoxelMap map;
  const Isometry3d front = testing::look_at({0.0, 0.5, 1.0}, {0.0, 2.0, 1.0});
  const Isometry3d back = testing::look_at({0.0, 3.54, 1.0}, {0.0, 2.0, 1.0});
  for (const Isometry3d& T : {front, back}) {
    const auto frame = testing::render({wall}, testing::kinect_camera(4), T).frame;
    const SurfaceImage surfaces(frame, 0.4, 5.0);
    map.insert(frame, T, &surfaces);
  }
  const auto surfels = map.surfels_in(frustum_at(front)).surfels;
  const auto inner = std::count_if(surfels.begin(), surfels.end(), [](const Surfel& s) {
    return std::abs(s.position.x()) < 0.5 && std::abs(s.position.z() - 1.0) < 0.4;
  });
  EXPECT_EQ(inner, 0);
}

}  // namespace
}  // namespace geomap::perception
