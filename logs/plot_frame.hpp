// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "mapping/export_svg_canvas.hpp"

namespace geomap::logs {

/// @brief What an axis shows, and what stands beside it.
struct PlotAxis {
  double low = 0.0;
  double high = 1.0;         // above low
  std::string label;         // with the unit: "x [m]"
  bool logarithmic = false;  // then low is above 0

  /// @brief Where a value lies: 0 at low, 1 at high.
  double share(double value) const;
};

/// @brief A rectangle of a picture with two axes.
struct PlotFrame {
  std::string title;
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();      // upper left, of the area of the data [px]
  Eigen::Vector2d size = Eigen::Vector2d(100.0, 100.0);  // [px]
  PlotAxis x;                                            // to the right
  PlotAxis y;                                            // upwards

  Eigen::Vector2d to_picture(const Eigen::Vector2d& value) const;
};

/// @brief Room to leave around the area of the data [px]: for numbers, and for title and labels.
inline constexpr double kPlotLeft = 56.0;
inline constexpr double kPlotTop = 46.0;
inline constexpr double kPlotBottom = 44.0;

/// @brief Round values within an axis, 1, 2 or 5 times a power of ten apart: at most about `wanted`
/// of them, but two at least. Of a logarithmic axis: 1, 2 and 5 times the powers of ten, only these
/// powers where that would be more than `wanted`.
std::vector<double> ticks_of(const PlotAxis& axis, double wanted);

/// @brief Grid, ticks with their numbers, labels and title.
void draw_frame(mapping::SvgCanvas& canvas, const PlotFrame& frame);

/// @brief A line through values; those that fall together in the picture are drawn once. A dot
/// where all of them do.
void draw_curve(mapping::SvgCanvas& canvas, const PlotFrame& frame,
                const std::vector<Eigen::Vector2d>& values, std::string_view color, double width);

}  // namespace geomap::logs
