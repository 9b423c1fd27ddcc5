// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "mapping/export_svg_canvas.hpp"
#include "mapping/export_svg_view.hpp"

namespace geomap::mapping {

inline constexpr double kPanelCaption = 30.0;    // height of the line above a drawing [px]
inline constexpr double kPanelGutter = 84.0;     // width left of a drawing, for the axes [px]
inline constexpr double kPanelMinHeight = 84.0;  // so that the axes fit [px]

/// @brief One view on the sheet.
struct SvgPanel {
  SvgView view = SvgView::kTop;
  ViewAxes axes;
  std::vector<ProjectedFeature> features;
  std::vector<ProjectedFeature> deleted;             // surfaces that are kept out of the map
  Eigen::AlignedBox2d box;                           // what the drawing holds, along the axes [m]
  double scale = 1.0;                                // [px/m]
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  // upper left, of the caption [px]

  /// @brief Size with caption and gutter [px].
  Eigen::Vector2d size() const;
};

/// @brief What a panel's drawing depends on besides the map.
struct PanelStyle {
  double heading = 0.0;  // of the front view [rad]
  bool labels = true;
  std::vector<FeatureId> highlighted;  // ascending
};

void draw_panel(SvgCanvas& canvas, const SvgPanel& panel, const PanelStyle& style);

}  // namespace geomap::mapping
