// SPDX-License-Identifier: BSD-3-Clause
#include "logs/trajectory_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "logs/plot_frame.hpp"
#include "mapping/export_features.hpp"

namespace geomap::logs {
namespace {

using Eigen::Vector2d;
using mapping::SvgCanvas;

constexpr std::string_view kReferenceColor = "#8a94a0";
constexpr std::string_view kAlignedColor = "#1f5fb4";
constexpr std::string_view kAnchoredColor = "#d9661f";
constexpr double kReferenceWidth = 4.0;  // [px], so that it shows beneath the estimate
constexpr double kEstimateWidth = 1.6;   // [px]

// All in pixels.
constexpr double kMargin = 28.0;
constexpr double kHeader = 92.0;
constexpr double kColumn = 460.0;  // width of a panel's area
constexpr double kTallest = 560.0;
constexpr double kLowestView = 90.0;
constexpr double kLowestErrors = 190.0;
constexpr double kPad = 22.0;           // between the paths and their panel's edge
constexpr double kSmallestPath = 0.02;  // [m], keeps the scale of a camera at rest in bounds

using Points = std::vector<Eigen::Vector3d>;

/// Two of the world's axes: to the right and upwards.
struct View {
  int right = 0;
  int up = 1;
  Vector2d project(const Eigen::Vector3d& point) const { return {point[right], point[up]}; }
};

struct Paths {
  Points reference;
  Points estimate;  // aligned
  Eigen::AlignedBox3d box;
};

Paths paths_of(const TrajectoryMetrics& metrics, const Trajectory& reference) {
  Paths paths;
  for (const auto& [utime, T] : reference) {
    const bool within = metrics.pairs.front().utime <= utime && utime <= metrics.pairs.back().utime;
    if (within) paths.reference.push_back(T.translation());
  }
  for (const PosePair& pair : metrics.pairs) {
    paths.estimate.push_back(metrics.aligned.T_reference_estimate *
                             pair.T_world_estimate.translation());
  }
  for (const Points* points : {&paths.reference, &paths.estimate}) {
    for (const Eigen::Vector3d& point : *points) paths.box.extend(point);
  }
  return paths;
}

// An axis that shows `pixels` at a scale [px/m], the middle of the paths in its middle.
PlotAxis metric_axis(const Paths& paths, int axis, double pixels, double scale) {
  constexpr std::array<std::string_view, 3> kNames = {"x", "y", "z"};
  const double middle = paths.box.center()[axis];
  return {middle - pixels / scale / 2.0, middle + pixels / scale / 2.0,
          fmt::format("{} [m]", kNames[static_cast<std::size_t>(axis)])};
}

PlotFrame view_frame(const Paths& paths, const View& view, const Vector2d& size, double scale) {
  PlotFrame frame;
  frame.size = size;
  frame.x = metric_axis(paths, view.right, size.x(), scale);
  frame.y = metric_axis(paths, view.up, size.y(), scale);
  return frame;
}

std::vector<Vector2d> project(const Points& points, const View& view) {
  std::vector<Vector2d> projected;
  for (const Eigen::Vector3d& point : points) projected.push_back(view.project(point));
  return projected;
}

void draw_view(SvgCanvas& canvas, const PlotFrame& frame, const Paths& paths, const View& view) {
  draw_frame(canvas, frame);
  draw_curve(canvas, frame, project(paths.reference, view), kReferenceColor, kReferenceWidth);
  draw_curve(canvas, frame, project(paths.estimate, view), kAlignedColor, kEstimateWidth);
  const auto mark = [&](const Points& points, std::string_view color) {
    const Vector2d at = frame.to_picture(view.project(points.front()));
    canvas.circle(at, 5.0, {.fill = "#ffffff", .stroke = std::string(color), .stroke_width = 2.0});
    return at;
  };
  mark(paths.reference, kReferenceColor);
  const Vector2d start = mark(paths.estimate, kAlignedColor);
  const bool at_right = start.x() > frame.corner.x() + frame.size.x() - 60.0;
  canvas.text(
      start + Vector2d(at_right ? -9.0 : 9.0, -7.0), "start",
      {.anchor = at_right ? mapping::TextAnchor::kEnd : mapping::TextAnchor::kStart, .halo = true});
}

std::vector<Vector2d> errors_over_time(const std::vector<PosePair>& pairs,
                                       const std::vector<double>& errors) {
  std::vector<Vector2d> values;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto since_start = static_cast<double>(pairs[i].utime - pairs.front().utime);
    values.emplace_back(1e-6 * since_start, 100.0 * errors[i]);
  }
  return values;
}

void draw_errors(SvgCanvas& canvas, PlotFrame frame, const TrajectoryMetrics& metrics) {
  const auto aligned = errors_over_time(metrics.pairs, metrics.aligned.errors);
  const auto anchored = errors_over_time(metrics.pairs, metrics.anchored.errors);
  const double largest =
      100.0 * std::max(metrics.aligned.statistics.max, metrics.anchored.statistics.max);
  frame.title = "Distance from the reference over time";
  frame.x = {0.0, std::max(aligned.back().x(), 0.1), "time since the first pose [s]"};
  frame.y = {0.0, std::max(1.08 * largest, 0.01), "distance [cm]"};
  draw_frame(canvas, frame);
  draw_curve(canvas, frame, anchored, kAnchoredColor, kEstimateWidth);
  draw_curve(canvas, frame, aligned, kAlignedColor, kEstimateWidth);
}

void draw_header(SvgCanvas& canvas, const TrajectoryMetrics& metrics, const std::string& title) {
  canvas.text({kMargin, kMargin + 14.0}, title, {.size = 20.0, .bold = true});
  canvas.text({kMargin, kMargin + 37.0},
              fmt::format("{} matched poses · rms distance aligned {:.2f} cm, anchored {:.2f} cm",
                          metrics.pairs.size(), 100.0 * metrics.aligned.statistics.rmse,
                          100.0 * metrics.anchored.statistics.rmse),
              {.size = 13.0, .color = "#52606d"});
  const auto entry = [&](double x, std::string_view color, double width, std::string_view text) {
    const Vector2d at(x, kMargin + 62.0);
    canvas.line(at, at + Vector2d(26.0, 0.0), color, width);
    canvas.text(at + Vector2d(34.0, 4.0), text, {});
    return x + 60.0 + mapping::text_width(text, 12.0);
  };
  double x = entry(kMargin, kReferenceColor, kReferenceWidth, "reference");
  x = entry(x, kAlignedColor, 2.0, "estimate, aligned as a whole");
  entry(x, kAnchoredColor, 2.0, "estimate, anchored at its first pose");
}

}  // namespace

std::string trajectory_svg(const TrajectoryMetrics& metrics, const Trajectory& reference,
                           const std::string& title) {
  if (metrics.pairs.empty()) throw std::invalid_argument("trajectory_svg: no pairs of poses");
  const Paths paths = paths_of(metrics, reference);
  const Eigen::Vector3d extent = paths.box.sizes().cwiseMax(kSmallestPath);
  const View above{0, 1};
  const View side{extent.x() >= extent.y() ? 0 : 1, 2};
  const double scale = std::min((kColumn - 2.0 * kPad) / std::max(extent.x(), extent.y()),
                                (kTallest - 2.0 * kPad) / std::max(extent.y(), extent.z()));
  const double side_height = std::max(extent.z() * scale + 2.0 * kPad, kLowestView);
  const double between = kPlotBottom + kPlotTop;
  const double above_height =
      std::max(extent.y() * scale + 2.0 * kPad, side_height + between + kLowestErrors);

  PlotFrame left = view_frame(paths, above, {kColumn, above_height}, scale);
  left.title = "From above";
  left.corner = {kMargin + kPlotLeft, kHeader + kMargin + kPlotTop};
  PlotFrame right = view_frame(paths, side, {kColumn, side_height}, scale);
  right.title = "From the side";
  right.corner = left.corner + Vector2d(kColumn + kPlotLeft + kMargin, 0.0);
  PlotFrame errors;
  errors.corner = right.corner + Vector2d(0.0, side_height + between);
  errors.size = {kColumn, above_height - side_height - between};

  SvgCanvas canvas;
  const std::string clean_title = mapping::clean_text(title);
  draw_header(canvas, metrics, clean_title);
  draw_view(canvas, left, paths, above);
  draw_view(canvas, right, paths, side);
  draw_errors(canvas, errors, metrics);
  const Vector2d corner = right.corner + Vector2d(kColumn, above_height);
  return canvas.finish({std::max(corner.x(), mapping::text_width(clean_title, 20.0)) + kMargin,
                        corner.y() + kPlotBottom + kMargin / 2.0},
                       clean_title);
}

}  // namespace geomap::logs
