// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "viewer/palette.hpp"
#include "viewer/scene_model.hpp"

namespace geomap::viewer {

/// @brief What the colour of a polygon tells.
enum class PolygonColor { kAsSeen, kId, kLabel, kNormal, kAge, kWeight };
inline constexpr std::array<const char*, 6> kPolygonColorNames = {"as seen", "id",  "label",
                                                                  "normal",  "age", "weight"};

/// @brief Chooses the colours of a map's polygons; knows the ends of the scales.
class PolygonColors {
 public:
  /// @brief Takes the ends of the scales from the map.
  void update(const Features& features);

  /// @brief Opaque, unlit.
  Rgba operator()(PolygonColor what, const mapping::ViewFeature& feature) const;

 private:
  std::int64_t oldest_ = 0, newest_ = 0;  // key frames [us]
  double most_ = 1.0;                     // observations
};

}  // namespace geomap::viewer
