// SPDX-License-Identifier: BSD-3-Clause
#include "logs/plot_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace geomap::logs {
namespace {

using Eigen::Vector2d;
using mapping::SvgCanvas;
using mapping::TextAnchor;

constexpr std::string_view kGrid = "#e4e7eb";
constexpr std::string_view kInk = "#52606d";
constexpr double kNumberSize = 12.0;    // [px]
constexpr double kTitleSize = 14.0;     // [px]
constexpr double kColumnOfTick = 75.0;  // [px], so that numbers do not touch
constexpr double kRowOfTick = 30.0;     // [px]
constexpr double kSamePlace = 0.4;      // [px]

// 1, 2 or 5 times a power of ten, at least `least`.
double round_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (digit * power >= least * (1.0 - 1e-9)) return digit * power;
  }
  return 10.0 * power;
}

std::vector<double> multiples(const PlotAxis& axis, double step) {
  std::vector<double> values;
  const double first = std::ceil(axis.low / step - 1e-9);
  for (double i = 0.0; (first + i) * step <= axis.high + 1e-9 * step; ++i) {
    values.push_back((first + i) * step);
  }
  return values;
}

std::vector<double> logarithmic_ticks(const PlotAxis& axis, std::initializer_list<double> digits) {
  std::vector<double> values;
  const double first = std::floor(std::log10(axis.low));
  for (double power = first; power <= std::log10(axis.high); ++power) {
    for (const double digit : digits) {
      const double value = digit * std::pow(10.0, power);
      const bool within = value >= axis.low * (1.0 - 1e-9) && value <= axis.high * (1.0 + 1e-9);
      if (within) values.push_back(value);
    }
  }
  return values;
}

// With as many decimals as tell neighbouring ticks apart.
std::string number_text(double value, const std::vector<double>& ticks, const PlotAxis& axis) {
  if (axis.logarithmic) return fmt::format("{:g}", value);
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;
  const int decimals = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-6)), 0, 6);
  const double unit = std::pow(10.0, -decimals);
  const bool is_zero = std::abs(value) < 0.5 * unit;  // never "-0"
  return fmt::format("{:.{}f}", is_zero ? 0.0 : value, decimals);
}

void draw_x_ticks(SvgCanvas& canvas, const PlotFrame& frame) {
  const std::vector<double> ticks = ticks_of(frame.x, frame.size.x() / kColumnOfTick);
  const double bottom = frame.corner.y() + frame.size.y();
  for (const double value : ticks) {
    const double x = frame.to_picture({value, frame.y.low}).x();
    canvas.line({x, frame.corner.y()}, {x, bottom}, kGrid, 1.0);
    canvas.text({x, bottom + 17.0}, number_text(value, ticks, frame.x),
                {.size = kNumberSize, .color = kInk, .anchor = TextAnchor::kMiddle});
  }
}

void draw_y_ticks(SvgCanvas& canvas, const PlotFrame& frame) {
  const std::vector<double> ticks = ticks_of(frame.y, frame.size.y() / kRowOfTick);
  for (const double value : ticks) {
    const double y = frame.to_picture({frame.x.low, value}).y();
    canvas.line({frame.corner.x(), y}, {frame.corner.x() + frame.size.x(), y}, kGrid, 1.0);
    canvas.text({frame.corner.x() - 7.0, y + 4.0}, number_text(value, ticks, frame.y),
                {.size = kNumberSize, .color = kInk, .anchor = TextAnchor::kEnd});
  }
}

}  // namespace

double PlotAxis::share(double value) const {
  if (logarithmic) return std::log(value / low) / std::log(high / low);
  return (value - low) / (high - low);
}

Vector2d PlotFrame::to_picture(const Vector2d& value) const {
  const Vector2d share(x.share(value.x()), 1.0 - y.share(value.y()));
  return corner + share.cwiseProduct(size);
}

std::vector<double> ticks_of(const PlotAxis& axis, double wanted) {
  if (axis.logarithmic) {
    const std::vector<double> ticks = logarithmic_ticks(axis, {1.0, 2.0, 5.0});
    const bool crowded = static_cast<double>(ticks.size()) > std::max(wanted, 2.0);
    return crowded ? logarithmic_ticks(axis, {1.0}) : ticks;
  }
  const double range = axis.high - axis.low;
  const std::vector<double> ticks = multiples(axis, round_step(range / std::max(wanted, 1.0)));
  // A single number tells no scale. A step is at most 2.5 times what it must be, so 5 give two.
  return ticks.size() < 2 ? multiples(axis, round_step(range / 5.0)) : ticks;
}

void draw_frame(SvgCanvas& canvas, const PlotFrame& frame) {
  draw_x_ticks(canvas, frame);
  draw_y_ticks(canvas, frame);
  canvas.rectangle(frame.corner, frame.size, {.stroke = "#9aa5b1"});
  const double left = frame.corner.x() - kPlotLeft + 14.0;
  canvas.text({left, frame.corner.y() - 28.0}, frame.title, {.size = kTitleSize, .bold = true});
  canvas.text({left, frame.corner.y() - 10.0}, frame.y.label, {.size = kNumberSize, .color = kInk});
  canvas.text(frame.corner + frame.size + Vector2d(0.0, 36.0), frame.x.label,
              {.size = kNumberSize, .color = kInk, .anchor = TextAnchor::kEnd});
}

void draw_curve(SvgCanvas& canvas, const PlotFrame& frame, const std::vector<Vector2d>& values,
                std::string_view color, double width) {
  std::vector<Vector2d> points;
  for (const Vector2d& value : values) {
    const Vector2d point = frame.to_picture(value);
    if (points.empty() || (point - points.back()).norm() >= kSamePlace) points.push_back(point);
  }
  if (points.size() == 1) canvas.circle(points.front(), width, {.fill = std::string(color)});
  canvas.polyline(points, color, width);
}

}  // namespace geomap::logs
