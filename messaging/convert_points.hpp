// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "geomap/point_map_update_t.hpp"

namespace geomap::messaging {

/// @brief A point of the point map as it travels.
struct ColoredPoint {
  Eigen::Vector3d position;  // world frame [m], to 1/65536 of a block's edge
  std::array<std::uint8_t, 3> color;
};

/// @brief The points of one block; none: the block is gone.
struct PointBlock {
  std::array<std::int32_t, 3> index;
  std::vector<ColoredPoint> points;
};

/// @brief The blocks of a message; nothing when it does not hold what it promises, or reaches
/// farther than 100 km from the origin.
std::optional<std::vector<PointBlock>> from_message(const geomap::point_map_update_t& message);

}  // namespace geomap::messaging
