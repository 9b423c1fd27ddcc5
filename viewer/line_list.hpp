// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "viewer/gl_buffer.hpp"
#include "viewer/palette.hpp"

namespace geomap::viewer {

/// @brief The colour in whole numbers, for a vertex.
std::array<std::uint8_t, 4> bytes_of(const Rgba& color);

/// @brief Adds a straight line. Metres, frame of the buffer.
void add_line(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Rgba& color,
              std::vector<Vertex>& lines);

/// @brief Adds a line with a head of four strokes at its end, a share of its length.
void add_arrow(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Rgba& color,
               std::vector<Vertex>& lines);

}  // namespace geomap::viewer
