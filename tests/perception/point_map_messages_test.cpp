// SPDX-License-Identifier: BSD-3-Clause
#include "perception/point_map_messages.hpp"

#include <gtest/gtest.h>

#include "messaging/convert_points.hpp"
#include "perception/point_map.hpp"
#include "support/plane_renderer.hpp"

namespace geomap::perception {
namespace {

using messaging::from_message;

// A room seen once, in voxels fine enough for more than one message.
class RoomPoints : public ::testing::Test {
 protected:
  RoomPoints() : map_(fine_voxels()) {
    const Eigen::Isometry3d T_world_camera =
        testing::look_at({-1.31, -0.87, 1.23}, {0.7, 0.6, 0.5});
    map_.insert(
        1,
        testing::render(testing::small_room(), testing::kinect_camera(2), T_world_camera, 0.004, 1)
            .frame,
        T_world_camera);
  }
  static PointMapConfig fine_voxels() {
    PointMapConfig config;
    config.voxels.voxel_size = 0.01;
    config.max_keyframe_bytes = 1'000'000;
    return config;
  }
  std::vector<geomap::point_map_update_t> all() const {
    return to_messages(map_.voxels(), map_.voxels().blocks(), true);
  }

  PointMap map_;
};

TEST_F(RoomPoints, ArriveWithinAStepOfTheirPlacesAndInTheirColors) {
  const auto messages = all();
  ASSERT_GT(messages.size(), 1u);
  std::vector<BlockIndex> seen;
  for (const auto& message : messages) {
    EXPECT_EQ(message.complete != 0, &message == &messages.front());
    EXPECT_LT(message.size, 190'000);
    const auto blocks = from_message(message);
    ASSERT_TRUE(blocks);
    for (const messaging::PointBlock& block : *blocks) {
      const auto [i_x, i_y, i_z] = block.index;
      seen.push_back({i_x, i_y, i_z});
      const std::vector<MapPoint> points = map_.voxels().block_points(seen.back());
      ASSERT_EQ(block.points.size(), points.size());
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Eigen::Vector3d off = block.points[i].position - points[i].position;
        EXPECT_LE(off.cwiseAbs().maxCoeff(), message.block_edge / 65536.0);
        EXPECT_EQ(block.points[i].color, points[i].color);
      }
    }
  }
  EXPECT_EQ(seen, map_.voxels().blocks());
}

TEST_F(RoomPoints, OnlyWhatChangedIsNamedAndWhatIsGoneIsEmpty) {
  EXPECT_EQ(map_.take_changed_blocks(), map_.voxels().blocks());
  EXPECT_TRUE(map_.take_changed_blocks().empty());
  const std::vector<BlockIndex> before = map_.voxels().blocks();
  map_.remove(1);
  const std::vector<BlockIndex> changed = map_.take_changed_blocks();
  EXPECT_EQ(changed, before);
  for (const auto& message : to_messages(map_.voxels(), changed, false)) {
    EXPECT_EQ(message.complete, 0);
    const auto blocks = from_message(message);
    ASSERT_TRUE(blocks);
    for (const messaging::PointBlock& block : *blocks) EXPECT_TRUE(block.points.empty());
  }
}

TEST_F(RoomPoints, AnEmptyMapIsAMessageToo) {
  map_.clear();
  const auto messages = all();
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_TRUE(messages[0].complete);
  EXPECT_TRUE(from_message(messages[0])->empty());
}

TEST_F(RoomPoints, WhatDoesNotHoldWhatItPromisesIsRefused) {
  const geomap::point_map_update_t sound = all().front();
  ASSERT_TRUE(from_message(sound));
  const auto refused = [&](auto change) {
    geomap::point_map_update_t message = sound;
    change(message);
    return !from_message(message);
  };
  EXPECT_TRUE(refused([](auto& message) { message.data.resize(message.data.size() / 2); }));
  EXPECT_TRUE(refused([](auto& message) { ++message.n_blocks; }));
  EXPECT_TRUE(refused([](auto& message) { message.n_blocks = -1; }));
  EXPECT_TRUE(refused([](auto& message) { --message.uncompressed_size; }));
  EXPECT_TRUE(refused([](auto& message) { message.uncompressed_size = -1; }));
  EXPECT_TRUE(refused([](auto& message) { message.uncompressed_size = INT32_MAX; }));
  EXPECT_TRUE(refused([](auto& message) { message.block_edge = 0.0; }));
  EXPECT_TRUE(refused([](auto& message) { message.block_edge = 90e3; }));
  EXPECT_TRUE(refused([](auto& message) { message.data.clear(); }));
}

}  // namespace
}  // namespace geomap::perception
