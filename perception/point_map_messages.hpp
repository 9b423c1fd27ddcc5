// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "geomap/point_map_update_t.hpp"
#include "perception/voxel_map.hpp"

namespace geomap::perception {

/// @brief Blocks of the point map as the channel POINT_MAP carries them, in as many messages as
/// keep each one small enough for every LCM tool. utime, session, epoch and sequence are the
/// publisher's.
/// @param complete all of the map: what is not in it is gone. Then `blocks` must be all blocks, and
/// there is a message even for none. messaging/convert_points.hpp has the inverse.
std::vector<geomap::point_map_update_t> to_messages(const VoxelMap& map,
                                                    std::span<const BlockIndex> blocks,
                                                    bool complete);

}  // namespace geomap::perception
