// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "mapping/export_svg_canvas.hpp"
#include "mapping/export_svg_panel.hpp"
#include "mapping/map_snapshot.hpp"

namespace geomap::mapping {

/// @brief Bar with its length: 1, 2 or 5 times a power of ten, drawn at most 170 px long.
/// @param scale of the drawings [px/m].
void draw_scale_bar(SvgCanvas& canvas, const Eigen::Vector2d& at, double scale);
/// @brief Room to leave for it, with its text [px].
double scale_bar_width(double scale);

/// @brief One swatch and what it means.
struct LegendEntry {
  std::array<Rgb, 2> colors;  // left and right half of the swatch
  std::string text;
  double opacity = 1.0;
  double outline = 0.8;  // width [px]
  bool is_deleted = false;
};

/// @brief Entries for the kinds of faces that are in the map, and for faces seen from behind when a
/// panel has any.
std::vector<LegendEntry> legend_of(const MapSnapshot& map, const std::vector<SvgPanel>& panels);
double legend_width(const std::vector<LegendEntry>& entries);  // [px]
void draw_legend(SvgCanvas& canvas, Eigen::Vector2d at, const std::vector<LegendEntry>& entries);

}  // namespace geomap::mapping
