// SPDX-License-Identifier: BSD-3-Clause
#include "perception/voxel_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "support/plane_renderer.hpp"

namespace geomap::perception {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using geometry::RgbdFrame;

struct View {
  RgbdFrame frame;
  Isometry3d T_world_camera;
};

/// Views of the small room, moved as a whole by `offset`.
std::vector<View> views(int count, const Vector3d& offset = Vector3d::Zero()) {
  std::vector<View> result;
  for (int i = 0; i < count; ++i) {
    const Isometry3d T_room_camera =
        testing::look_at({-1.31 + 0.13 * i, -0.87 + 0.07 * i, 1.23}, {0.7, 0.6, 0.5});
    const auto rendering = testing::render(testing::small_room(), testing::kinect_camera(8),
                                           T_room_camera, 0.004, static_cast<std::uint32_t>(i + 1));
    result.push_back({rendering.frame, Eigen::Translation3d(offset) * T_room_camera});
  }
  return result;
}

VoxelMap map_of(const std::vector<View>& views, const VoxelMapConfig& config = {}) {
  VoxelMap map(config);
  for (const View& view : views) map.insert(view.frame, view.T_world_camera);
  return map;
}

/// The oracle: every reading in a list per voxel, in floating point.
struct Heap {
  std::vector<Vector3d> points;
  Eigen::Array3d color = Eigen::Array3d::Zero();
};
using Voxel = std::array<long, 3>;

Voxel voxel_of(const Vector3d& p, double size) {
  return {std::lround(std::floor(p.x() / size)), std::lround(std::floor(p.y() / size)),
          std::lround(std::floor(p.z() / size))};
}

std::map<Voxel, Heap> brute_force(const std::vector<View>& views, const VoxelMapConfig& config) {
  std::map<Voxel, Heap> heaps;
  for (const auto& [frame, T_world_camera] : views) {
    for (int v = 0; v < frame.depth.height; ++v) {
      for (int u = 0; u < frame.depth.width; ++u) {
        const std::uint16_t reading = frame.depth.at(u, v);
        const double z = 1e-3 * reading;
        if (!geometry::DepthImage::is_reading(reading)) continue;
        if (z < config.min_depth || z > config.max_depth) continue;
        const Vector3d p = T_world_camera * frame.depth_camera.point(u, v, z);
        Heap& heap = heaps[voxel_of(p, config.voxel_size)];
        heap.points.push_back(p);
        const auto pixel = static_cast<std::size_t>(v * frame.depth.width + u);
        for (std::size_t c = 0; c < 3; ++c) {
          heap.color(static_cast<int>(c)) += frame.color.rgb[3 * pixel + c];
        }
      }
    }
  }
  return heaps;
}

void expect_same(const std::vector<MapPoint>& a, const std::vector<MapPoint>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].position, b[i].position);
    EXPECT_EQ(a[i].covariance, b[i].covariance);
    EXPECT_EQ(a[i].readings, b[i].readings);
    EXPECT_EQ(a[i].color, b[i].color);
  }
}

TEST(VoxelMap, VoxelsHoldTheMomentsOfTheirPoints) {
  const VoxelMapConfig config;
  const std::vector<View> all = views(3);
  const VoxelMap map = map_of(all, config);
  const auto heaps = brute_force(all, config);
  ASSERT_GT(heaps.size(), 2000U);
  EXPECT_EQ(map.size(), heaps.size());
  for (const auto& [voxel, heap] : heaps) {
    const auto n = static_cast<double>(heap.points.size());
    Vector3d mean = Vector3d::Zero();
    for (const Vector3d& p : heap.points) mean += p / n;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const Vector3d& p : heap.points) covariance += (p - mean) * (p - mean).transpose() / n;
    const auto point = map.at(heap.points.front());
    ASSERT_TRUE(point);
    EXPECT_EQ(point->readings, static_cast<std::int64_t>(heap.points.size()));
    EXPECT_LT((point->position - mean).norm(), 1e-5);
    EXPECT_LT((point->covariance - covariance).norm(), 3e-7);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(point->color[c], heap.color(static_cast<int>(c)) / n, 0.501);
    }
  }
}

TEST(VoxelMap, CountsTheReadingsItTakes) {
  const VoxelMapConfig config;
  const std::vector<View> one = views(1);
  std::size_t expected = 0;
  for (const auto& [voxel, heap] : brute_force(one, config)) expected += heap.points.size();
  EXPECT_EQ(VoxelMap(config).insert(one[0].frame, one[0].T_world_camera), expected);
}

TEST(VoxelMap, TheOrderOfFramesDoesNotMatter) {
  std::vector<View> all = views(4);
  const auto forwards = map_of(all).points();
  std::reverse(all.begin(), all.end());
  expect_same(map_of(all).points(), forwards);
}

TEST(VoxelMap, ARemovedFrameLeavesTheMapThatWasNeverToldOfIt) {
  std::vector<View> all = views(4);
  VoxelMap map = map_of(all);
  map.remove(all[1].frame, all[1].T_world_camera);
  all.erase(all.begin() + 1);
  const VoxelMap without = map_of(all);
  expect_same(map.points(), without.points());
  EXPECT_EQ(map.blocks(), without.blocks());
  EXPECT_EQ(map.size(), without.size());
  EXPECT_EQ(map.memory_bytes(), without.memory_bytes());
  for (const View& view : all) map.remove(view.frame, view.T_world_camera);
  EXPECT_EQ(map.size(), 0U);
  EXPECT_TRUE(map.blocks().empty());
  EXPECT_EQ(map.memory_bytes(), 0U);
}

TEST(VoxelMap, RefusesToRemoveWhatIsNotThere) {
  const std::vector<View> all = views(2);
  VoxelMap map = map_of({all[0]});
  const Isometry3d elsewhere = Eigen::Translation3d(9.0, 0.0, 0.0) * all[0].T_world_camera;
  EXPECT_THROW(map.remove(all[0].frame, elsewhere), std::invalid_argument);
}

TEST(VoxelMap, IsAsPreciseAKilometreFromTheOrigin) {
  // A whole number of voxels away, so that the same points share the same voxels.
  const Vector3d offset(1024.0, -2048.0, 512.0);
  VoxelMapConfig config;
  config.voxel_size = 0.03125;
  const auto near = map_of(views(2), config).points();
  const auto far = map_of(views(2, offset), config).points();
  ASSERT_EQ(near.size(), far.size());
  for (std::size_t i = 0; i < near.size(); ++i) {
    EXPECT_LT((far[i].position - offset - near[i].position).norm(), 2e-5);
    EXPECT_LT((far[i].covariance - near[i].covariance).norm(), 1e-7);
  }
}

TEST(VoxelMap, PointsLieInTheirBlocksAndInOrder) {
  const VoxelMap map = map_of(views(2));
  std::vector<MapPoint> collected;
  const auto blocks = map.blocks();
  EXPECT_TRUE(std::is_sorted(blocks.begin(), blocks.end()));
  for (const BlockIndex& index : blocks) {
    const auto points = map.block_points(index);
    EXPECT_FALSE(points.empty());
    for (const MapPoint& point : points) {
      EXPECT_TRUE(map.block_box(index).contains(point.position));
      collected.push_back(point);
    }
  }
  expect_same(collected, map.points());
  EXPECT_TRUE(map.block_points({1000, 1000, 1000}).empty());
}

TEST(VoxelMap, FramesWithoutColourLeaveTheColourToOthers) {
  std::vector<View> all = views(1);
  const auto colored = map_of(all).points();
  RgbdFrame grey = all[0].frame;
  grey.color = {};
  VoxelMap map;
  map.insert(grey, all[0].T_world_camera);
  const std::array<std::uint8_t, 3> unknown = {128, 128, 128};
  EXPECT_EQ(map.points().front().color, unknown);
  map.insert(all[0].frame, all[0].T_world_camera);
  const auto both = map.points();
  ASSERT_EQ(both.size(), colored.size());
  for (std::size_t i = 0; i < both.size(); ++i) EXPECT_EQ(both[i].color, colored[i].color);
}

TEST(VoxelMap, LeavesOutWhatIsTooNearOrTooFar) {
  const std::vector<View> all = views(1);
  VoxelMapConfig config;
  config.min_depth = 1.5;
  config.max_depth = 2.0;
  const VoxelMap map = map_of(all, config);
  ASSERT_GT(map.size(), 100U);
  for (const MapPoint& point : map.points()) {
    const double z = (all[0].T_world_camera.inverse() * point.position).z();
    EXPECT_GT(z, 1.499);
    EXPECT_LT(z, 2.001);
  }
}

TEST(VoxelMap, AnEmptyFrameAddsNothing) {
  View blind = views(1).front();
  std::fill(blind.frame.depth.millimetres.begin(), blind.frame.depth.millimetres.end(),
            geometry::DepthImage::kInvalid);
  EXPECT_EQ(map_of({blind}).size(), 0U);
  EXPECT_TRUE(map_of({}).points().empty());
  EXPECT_FALSE(map_of({}).at(Vector3d::Zero()));
}

TEST(VoxelMap, RefusesFramesAndPosesThatMakeNoSense) {
  const View view = views(1).front();
  VoxelMap map;
  RgbdFrame cut = view.frame;
  cut.depth.millimetres.pop_back();
  EXPECT_THROW(map.insert(cut, view.T_world_camera), std::invalid_argument);
  cut = view.frame;
  cut.color.rgb.pop_back();
  EXPECT_THROW(map.insert(cut, view.T_world_camera), std::invalid_argument);
  Isometry3d pose = view.T_world_camera;
  pose.translation().x() = 2e6;
  EXPECT_THROW(map.insert(view.frame, pose), std::invalid_argument);
  pose.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(map.insert(view.frame, pose), std::invalid_argument);
  EXPECT_EQ(map.size(), 0U);
  VoxelMapConfig config;
  config.voxel_size = 0.0;
  config.max_depth = 0.1;
  EXPECT_EQ(config.validate().size(), 2U);
  EXPECT_THROW(VoxelMap{config}, std::invalid_argument);
}

}  // namespace
}  // namespace geomap::perception
