// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geomap/point_map_update_t.hpp"
#include "perception/voxel_map.hpp"

namespace geomap::perception {

/// @brief A point of the map as it travels.
struct ColoredPoint {
  Eigen::Vector3d position;  // world frame [m], to 1/65536 of a block's edge
  std::array<std::uint8_t, 3> color;
};

/// @brief The points of one block; none: the block is gone.
struct PointBlock {
  BlockIndex index;
  std::vector<ColoredPoint> points;
};

/// @brief Blocks of the point map as the channel POINT_MAP carries them, in as many messages as
/// keep each one small enough for every LCM tool. utime, session, epoch and sequence are the
/// publisher's.
/// @param complete all of the map: what is not in it is gone. Then `blocks` must be all blocks, and
/// there is a message even for none.
std::vector<geomap::point_map_update_t> to_messages(const VoxelMap& map,
                                                    std::span<const BlockIndex> blocks,
                                                    bool complete);

/// @brief The blocks of a message; nothing when it does not hold what it promises.
std::optional<std::vector<PointBlock>> from_message(const geomap::point_map_update_t& message);

}  // namespace geomap::perception
