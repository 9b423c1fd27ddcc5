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
constexpr std::size_t kHeadBytes = 16, kPointBytes = 9;

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

// Takes whole numbers from a blob's front; `is_short` once it has been asked for too many.
class BlobReader {
 public:
  explicit BlobReader(std::span<const std::uint8_t> blob) : blob_(blob) {}

  std::uint32_t take(std::size_t bytes) {
    if (blob_.size() < bytes) {
      is_short_ = true;
      return 0;
    }
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i) value |= std::uint32_t{blob_[i]} << (8 * i);
    blob_ = blob_.subspan(bytes);
    return value;
  }
  std::size_t left() const { return blob_.size(); }
  bool is_short() const { return is_short_; }

 private:
  std::span<const std::uint8_t> blob_;
  bool is_short_ = false;
};

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

std::optional<std::vector<PointBlock>> from_message(const geomap::point_map_update_t& message) {
  if (message.uncompressed_size < 0 || !(message.block_edge > 0.0)) return std::nullopt;
  const auto blob =
      messaging::inflate_bytes(message.data, static_cast<std::size_t>(message.uncompressed_size));
  if (!blob) return std::nullopt;
  BlobReader reader(*blob);
  std::vector<PointBlock> blocks;
  while (reader.left() >= kHeadBytes) {
    PointBlock& block = blocks.emplace_back();
    for (std::int32_t* i : {&block.index.x, &block.index.y, &block.index.z}) {
      *i = static_cast<std::int32_t>(reader.take(4));
    }
    const std::size_t points = reader.take(4);
    if (points > reader.left() / kPointBytes) return std::nullopt;
    const Eigen::Vector3d corner(block.index.x, block.index.y, block.index.z);
    for (std::size_t i = 0; i < points; ++i) {
      ColoredPoint& point = block.points.emplace_back();
      for (int axis = 0; axis < 3; ++axis) {
        const double share = (static_cast<double>(reader.take(2)) + 0.5) / kSteps;
        point.position[axis] = message.block_edge * (corner[axis] + share);
      }
      for (std::uint8_t& channel : point.color) channel = static_cast<std::uint8_t>(reader.take(1));
    }
  }
  const bool is_whole = reader.left() == 0 && !reader.is_short() &&
                        blocks.size() == static_cast<std::size_t>(std::max(0, message.n_blocks));
  if (!is_whole) return std::nullopt;
  return blocks;
}

}  // namespace geomap::perception
