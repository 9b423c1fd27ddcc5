// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mapping/clean_text.hpp"
#include "mapping/map_feature.hpp"

namespace geomap::mapping {

/// @brief Red, green, blue, sRGB.
using Rgb = std::array<std::uint8_t, 3>;

/// @brief The features in ascending order of their ids: the order of every export, and what the
/// numbers #1, #2, ... of pictures count. The pointers live as long as the argument.
std::vector<const MapFeature*> sorted_by_id(std::span<const MapFeature> features);

/// @brief The feature's mean colour, or one of a palette, by index, when it was seen without
/// colour.
Rgb display_color(const MapFeature& feature, std::size_t index);

}  // namespace geomap::mapping
