// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>

#include "mapping/export_features.hpp"
#include "mapping/map_feature.hpp"

namespace geomap::mapping {

/// @brief Of the dashed outlines of deleted surfaces.
inline constexpr std::string_view kDeletedColor = "#a4161a";

enum class Orientation { kUp, kDown, kUpright, kInclined };

inline constexpr std::array<Orientation, 4> kOrientations = {
    Orientation::kUp, Orientation::kDown, Orientation::kUpright, Orientation::kInclined};

/// @brief Kind of a face by its normal: within 15° of up, of down, or of level; else inclined.
Orientation orientation_of(const MapFeature& feature);

std::string_view orientation_name(Orientation orientation);

/// @brief The colours that a kind of face runs between: first and last are the same, but for
/// upright faces, where the last one is that of faces which the front view sees edge-on.
std::array<Rgb, 2> orientation_colors(Orientation orientation);

/// @brief Fill of a feature in pictures: its orientation's colour, upright faces turning from blue
/// to green with the angle between them and the front view, mixed with the mean colour it was seen
/// in.
Rgb fill_color(const MapFeature& feature, double heading);

/// @brief The same hue, dark enough for an outline.
Rgb outline_color(const Rgb& fill);

}  // namespace geomap::mapping
