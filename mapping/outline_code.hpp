// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/polygon.hpp"

namespace geomap::mapping {

/// @brief A polygon in few bytes, exact; map_feature_t states the format. Three to four bytes a
/// vertex in place of eight, and next to nothing for what the receiver knows from the polygon
/// before: an outline that grows keeps most of its vertices.
std::vector<std::uint8_t> encode_outline(const geometry::Polygon& polygon,
                                         const geometry::Polygon& before = {});

/// @brief The inverse, for bytes that nobody vouches for: nothing when they end early or go on, or
/// when the polygon is empty, reaches farther than 1 km, has more than 20 000 vertices, or breaks
/// its invariant.
std::optional<geometry::Polygon> decode_outline(std::span<const std::uint8_t> bytes,
                                                const geometry::Polygon& before = {});

}  // namespace geomap::mapping
