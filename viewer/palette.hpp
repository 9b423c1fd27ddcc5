// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "mapping/map_feature.hpp"

namespace geomap::viewer {

/// @brief Red, green, blue, opacity, 0 to 1.
using Rgba = std::array<float, 4>;

constexpr Rgba with_alpha(Rgba color, float alpha) {
  color[3] = alpha;
  return color;
}

/// @brief Okabe and Ito's colours, which people with any kind of colour blindness tell apart.
inline constexpr std::array<Rgba, 7> kPalette = {{{0.90F, 0.62F, 0.00F, 1.0F},    // orange
                                                  {0.34F, 0.71F, 0.91F, 1.0F},    // sky blue
                                                  {0.00F, 0.62F, 0.45F, 1.0F},    // green
                                                  {0.94F, 0.89F, 0.26F, 1.0F},    // yellow
                                                  {0.00F, 0.45F, 0.70F, 1.0F},    // blue
                                                  {0.84F, 0.37F, 0.00F, 1.0F},    // vermilion
                                                  {0.80F, 0.47F, 0.65F, 1.0F}}};  // purple

/// @brief Colours of the drawing that depend on light or dark.
struct Theme {
  bool is_dark = true;
  Rgba background, foreground, grid, selected, hovered, ghost, warning, good, bad;
};
Theme dark_theme();
Theme light_theme();

/// @brief Always the same for one id, label or direction; neighbours in number differ.
Rgba color_of(const mapping::FeatureId& id);
Rgba color_of_label(const std::string& label);
/// @brief Of floors (up), ceilings (down), walls by heading, and inclined faces.
Rgba color_of_normal(const Eigen::Vector3d& normal);
/// @brief From few to many, a ramp whose lightness grows with the share, 0 to 1.
Rgba ramp(double share);

}  // namespace geomap::viewer
