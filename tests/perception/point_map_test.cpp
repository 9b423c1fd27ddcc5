// SPDX-License-Identifier: BSD-3-Clause
#include "perception/point_map.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "perception/point_map_checks.hpp"
#include "perception/thin_frame.hpp"
#include "support/plane_renderer.hpp"

namespace geomap::perception {
namespace {

using Eigen::Isometry3d;

constexpr std::int64_t kStart = 1'000'000'000'000'000;

struct View {
  std::int64_t id;
  geometry::RgbdFrame frame;
  Isometry3d T_world_camera;
};

std::vector<View> views(int count) {
  std::vector<View> result;
  for (int i = 0; i < count; ++i) {
    const Isometry3d T_world_camera =
        testing::look_at({-1.31 + 0.13 * i, -0.87 + 0.07 * i, 1.23}, {0.7, 0.6, 0.5});
    const auto rendering =
        testing::render(testing::small_room(), testing::kinect_camera(2), T_world_camera, 0.004,
                        static_cast<std::uint32_t>(i + 1));
    result.push_back({kStart + i * 33'333, rendering.frame, T_world_camera});
  }
  return result;
}

PointMap map_of(const std::vector<View>& views) {
  PointMap map;
  for (const View& view : views) map.insert(view.id, view.frame, view.T_world_camera);
  return map;
}

TEST(PointMap, HoldsTheReadingsOfThinFrames) {
  const std::vector<View> all = views(2);
  const PointMap map = map_of(all);
  VoxelMap expected;
  for (const View& view : all) expected.insert(thin_frame(view.frame, 40'000), view.T_world_camera);
  ASSERT_GT(expected.size(), 2000U);
  EXPECT_EQ(map.size(), expected.size());
  EXPECT_EQ(map.voxels().blocks(), expected.blocks());
  EXPECT_EQ(map.points().front().position, expected.points().front().position);
}

TEST(PointMap, KeepsNoMoreOfAKeyFrameThanAllowed) {
  const PointMap map = map_of(views(3));
  const std::size_t kept = map.memory_bytes() - map.voxels().memory_bytes();
  EXPECT_LE(kept, 3U * 40'000U);
  EXPECT_GT(kept, 3U * 10'000U);
}

TEST(PointMap, DroppingAKeyFrameIsAsIfItHadNeverBeen) {
  std::vector<View> all = views(4);
  PointMap map = map_of(all);
  EXPECT_TRUE(map.remove(all[1].id));
  EXPECT_FALSE(map.remove(all[1].id));
  all.erase(all.begin() + 1);
  testing::expect_same(map, map_of(all));
}

TEST(PointMap, MovingAKeyFrameIsAsIfItHadAlwaysBeenThere) {
  std::vector<View> all = views(3);
  PointMap map = map_of(all);
  all[1].T_world_camera = Eigen::Translation3d(0.02, 0.4, -0.1) * all[1].T_world_camera *
                          Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitY());
  EXPECT_TRUE(map.move(all[1].id, all[1].T_world_camera));
  EXPECT_FALSE(map.move(kStart - 1, all[1].T_world_camera));
  const PointMap expected = map_of(all);
  testing::expect_same(map, expected);
  map.remove(all[1].id);  // and it is remembered where it is now
  all.erase(all.begin() + 1);
  testing::expect_same(map, map_of(all));
}

TEST(PointMap, ARefusedFrameOrPoseChangesNothing) {
  const std::vector<View> all = views(2);
  PointMap map = map_of({all[0]});
  Isometry3d scaled = all[1].T_world_camera;
  scaled.linear() *= 1.1;
  geometry::RgbdFrame cut = all[1].frame;
  cut.depth.millimetres.pop_back();
  EXPECT_THROW(map.insert(all[0].id, all[1].frame, all[1].T_world_camera), std::invalid_argument);
  EXPECT_THROW(map.insert(all[1].id, all[1].frame, scaled), std::invalid_argument);
  EXPECT_THROW(map.insert(all[1].id, cut, all[1].T_world_camera), std::invalid_argument);
  EXPECT_THROW(map.move(all[0].id, scaled), std::invalid_argument);
  testing::expect_same(map, map_of({all[0]}));
}

TEST(PointMap, ClearLeavesAnEmptyMap) {
  const std::vector<View> all = views(2);
  PointMap map = map_of(all);
  map.clear();
  testing::expect_same(map, PointMap());
  map.insert(all[0].id, all[0].frame, all[0].T_world_camera);
  testing::expect_same(map, map_of({all[0]}));
}

TEST(PointMap, RefusesAConfigurationThatMakesNoSense) {
  PointMapConfig config;
  config.voxels.voxel_size = 0.0;
  config.max_keyframe_bytes = 0;
  EXPECT_EQ(config.validate().size(), 2U);
  EXPECT_THROW(PointMap{config}, std::invalid_argument);
}

}  // namespace
}  // namespace geomap::perception
