// SPDX-License-Identifier: BSD-3-Clause
#include "perception/point_map_messages.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "messaging/depth_codec.hpp"

namespace geomap::perception {
namespace {

constexpr std::size_t kMostBytes = 180'000;  // of a blob before it is deflated
constexpr double kSteps = 65536.0;           // of a coordinate inside a block

void append(std::uint32_t value, std::size_t bytes, std::vector<std::uint8_t>& blob) {
  for (std::size_t i = 0; i < bytes; ++i) {
    blob.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  }
}

void append_block(const VoxelMap& map, const BlockIndex& index, std::vector<std::uint8_t>& blob) {
  const Eigen::AlignedBox3d box = map.block_box(index);
  const std::vector<MapPoint> points = map.block_points(index);
  for (const std::int32_t i : {index.x, index.y, index.z}) {
    append(static_cast<std::uint32_t>(i), 4, blob);
  }
  append(static_cast<std::uint32_t>(points.size()), 4, blob);
  for (const MapPoint& point : points) {
    for (int axis = 0; axis < 3; ++axis) {
      const double share = (point.position[axis] - box.min()[axis]) / box.sizes()[axis];
      append(static_cast<std::uint32_t>(std::clamp(std::floor(share * kSteps), 0.0, kSteps - 1.0)),
             2, blob);
    }
    for (const std::uint8_t channel : point.color) append(channel, 1, blob);
  }
}

geomap::point_map_update_t message_of(const VoxelMap& map, const std::vector<std::uint8_t>& blob,
                                      int blocks) {
  geomap::point_map_update_t message{};
  message.block_edge = map.block_box({0, 0, 0}).sizes().x();
  message.n_blocks = blocks;
  message.uncompressed_size = static_cast<std::int32_t>(blob.size());
  message.data = messaging::deflate_bytes(blob);
  message.size = static_cast<std::int32_t>(message.data.size());
  return message;
}

}  // namespace

std::vector<geomap::point_map_update_t> to_messages(const VoxelMap& map,
                                                    std::span<const BlockIndex> blocks,
                                                    bool complete) {
  std::vector<geomap::point_map_update_t> messages;
  std::vector<std::uint8_t> blob;
  int count = 0;
  const auto finish = [&] {
    messages.push_back(message_of(map, blob, count));
    blob.clear();
    count = 0;
  };
  for (const BlockIndex& index : blocks) {
    append_block(map, index, blob);
    ++count;
    if (blob.size() >= kMostBytes) finish();
  }
  if (count > 0 || (complete && messages.empty())) finish();
  if (complete) messages.front().complete = 1;
  return messages;
}

}  // namespace geomap::perception
