// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/convert_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "messaging/depth_codec.hpp"

namespace geomap::messaging {
namespace {

constexpr double kSteps = 65536.0;  // of a coordinate inside a block
constexpr std::size_t kHeadBytes = 16, kPointBytes = 9;
constexpr double kFarthest = 100e3;  // of a block from the origin, along an axis [m]

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

std::optional<PointBlock> read_block(BlobReader& reader, double edge) {
  PointBlock block;
  Eigen::Vector3d corner;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    block.index[axis] = static_cast<std::int32_t>(reader.take(4));
    corner[static_cast<Eigen::Index>(axis)] = edge * block.index[axis];
  }
  const std::size_t points = reader.take(4);
  const bool is_far = corner.cwiseAbs().maxCoeff() > kFarthest;
  if (is_far || points > reader.left() / kPointBytes) return std::nullopt;
  block.points.reserve(points);
  for (std::size_t i = 0; i < points; ++i) {
    ColoredPoint& point = block.points.emplace_back();
    for (int axis = 0; axis < 3; ++axis) {
      const double share = (static_cast<double>(reader.take(2)) + 0.5) / kSteps;
      point.position[axis] = corner[axis] + edge * share;
    }
    for (std::uint8_t& channel : point.color) channel = static_cast<std::uint8_t>(reader.take(1));
  }
  return block;
}

}  // namespace

std::optional<std::vector<PointBlock>> from_message(const geomap::point_map_update_t& message) {
  if (!(message.block_edge > 0.0 && message.block_edge <= kFarthest)) return std::nullopt;
  if (message.uncompressed_size < 0) return std::nullopt;
  const auto blob =
      inflate_bytes(message.data, static_cast<std::size_t>(message.uncompressed_size));
  if (!blob) return std::nullopt;
  BlobReader reader(*blob);
  std::vector<PointBlock> blocks;
  while (reader.left() >= kHeadBytes) {
    auto block = read_block(reader, message.block_edge);
    if (!block) return std::nullopt;
    blocks.push_back(std::move(*block));
  }
  const bool is_whole = reader.left() == 0 && !reader.is_short() &&
                        blocks.size() == static_cast<std::size_t>(std::max(0, message.n_blocks));
  if (!is_whole) return std::nullopt;
  return blocks;
}

}  // namespace geomap::messaging
