// SPDX-License-Identifier: BSD-3-Clause
#include "logs/evaluation_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

#include "logs/paper_results.hpp"
#include "logs/plot_frame.hpp"

namespace geomap::logs {
namespace {

using Eigen::Vector2d;
using mapping::SvgCanvas;
using Groups = std::span<const RunGroup* const>;

constexpr std::string_view kPaperColor = "#8a94a0";
constexpr std::string_view kSecondExtractor = "#4b5563";
constexpr std::array<std::string_view, 6> kColors = {"#1f5fb4", "#d9661f", "#2e8b57",
                                                     "#8e44ad", "#b8860b", "#c0392b"};

// All in pixels.
constexpr double kWidth = 540.0;
constexpr double kMargin = 18.0;
constexpr double kPlotHeight = 250.0;
constexpr double kLegendRow = 20.0;

struct Curve {
  std::string name;
  std::string_view color;
  std::vector<Vector2d> points;
  double width = 2.0;  // [px]
  bool dots = false;   // measured points, not a course
};

std::string_view color_of(std::size_t index) { return kColors[index % kColors.size()]; }

// Entries one after the other, in as many rows as they need; returns the height.
double draw_legend(SvgCanvas& canvas, const std::vector<Curve>& curves) {
  Vector2d at(kMargin, kMargin);
  for (const Curve& curve : curves) {
    const double width = 54.0 + mapping::text_width(curve.name, 12.0);
    if (at.x() > kMargin && at.x() + width > kWidth) at = {kMargin, at.y() + kLegendRow};
    canvas.line(at, at + Vector2d(26.0, 0.0), curve.color, 3.0);
    canvas.text(at + Vector2d(32.0, 4.0), curve.name, {});
    at.x() += width;
  }
  return at.y() + kLegendRow - kMargin;
}

// An axis about all values with some air; from 0 where it is linear.
PlotAxis axis_of(const std::vector<Curve>& curves, int axis, const std::string& label,
                 bool logarithmic) {
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
  for (const Curve& curve : curves) {
    for (const Vector2d& point : curve.points) {
      low = std::min(low, point[axis]);
      high = std::max(high, point[axis]);
    }
  }
  if (logarithmic) return {low / 1.3, std::max(high, 2.0 * low) * 1.3, label, true};
  return {0.0, std::max(1.05 * high, 1e-9), label};
}

Picture plot(std::string name, const std::string& caption, const std::vector<Curve>& curves,
             PlotFrame frame) {
  SvgCanvas canvas;
  const double legend = draw_legend(canvas, curves);
  frame.corner = {kMargin + kPlotLeft, kMargin + legend + kPlotTop};
  frame.size = {kWidth - kPlotLeft - 2.0 * kMargin, kPlotHeight};
  draw_frame(canvas, frame);
  for (const Curve& curve : curves) {
    draw_curve(canvas, frame, curve.points, curve.color, curve.width);
    if (!curve.dots) continue;
    for (const Vector2d& point : curve.points) {
      canvas.circle(frame.to_picture(point), 4.0, {.fill = std::string(curve.color)});
    }
  }
  const double height = frame.corner.y() + kPlotHeight + kPlotBottom + 4.0;
  return {std::move(name), canvas.finish({kWidth, height}, frame.title), caption};
}

// A value for each key frame, counted from 1. On a logarithmic axis zero has no place.
std::vector<Vector2d> over_keyframes(const std::vector<double>& values) {
  std::vector<Vector2d> points;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] > 0.0) points.emplace_back(static_cast<double>(i + 1), values[i]);
  }
  return points;
}

std::vector<double> ratios(const RunReport& report) {
  std::vector<double> values;
  for (std::size_t i = 0; i < report.feature_growth.size(); ++i) {
    const double features = report.feature_growth[i];
    values.push_back(features > 0.0 ? report.extracted_growth.at(i) / features : 0.0);
  }
  return values;
}

void keep_drawable(std::vector<Curve>& curves) {
  std::erase_if(curves, [](const Curve& curve) { return curve.points.empty(); });
}

std::string seeds_text(Groups groups) {
  return fmt::format("{}, {}", set_title(groups.front()->set), groups.front()->runs.front()->seed);
}

// The paper's figure, with the noise in millimetres.
Curve paper_curve(const FigureKind& kind, std::span<const std::pair<const char*, double>> noises) {
  Curve curve{"paper", kPaperColor, {}, 2.5, true};
  for (const auto& [set, noise] : noises) {
    for (const PaperAccuracy& row : paper_accuracy()) {
      const double value = kind.member == &AccuracyFigures::d_angle ? row.d_angle : row.d_dist;
      if (row.set == set) curve.points.emplace_back(noise, kind.scale * value);
    }
  }
  return curve;
}

}  // namespace

std::optional<Picture> growth_picture(Groups groups) {
  std::vector<Curve> curves;
  std::set<std::string> extractors;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const RunReport& report = groups[i]->runs.front()->report;
    // Merging does not change what is extracted: one curve for each extractor.
    const std::string extracted =
        "extracted, " + groups[i]->variant.substr(0, groups[i]->variant.rfind('-'));
    if (extractors.insert(extracted).second) {
      curves.push_back({extracted, extractors.size() == 1 ? kPaperColor : kSecondExtractor,
                        over_keyframes(report.extracted_growth), 2.5});
    }
    curves.push_back(
        {"map, " + groups[i]->variant, color_of(i), over_keyframes(report.feature_growth)});
  }
  keep_drawable(curves);
  if (curves.empty()) return std::nullopt;
  PlotFrame frame;
  frame.title = "Planes extracted and planes in the map";
  frame.x = axis_of(curves, 0, "key frames", false);
  frame.y = axis_of(curves, 1, "planes, logarithmic", true);
  return plot("growth_" + groups.front()->set + ".svg",
              "Growth over the key frames (the paper's Figure 6): " + seeds_text(groups) + ".",
              curves, frame);
}

std::optional<Picture> reduction_picture(Groups groups) {
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    curves.push_back(
        {groups[i]->variant, color_of(i), over_keyframes(ratios(groups[i]->runs.front()->report))});
  }
  keep_drawable(curves);
  if (curves.empty()) return std::nullopt;
  PlotFrame frame;
  frame.title = "Planes extracted for each plane in the map";
  for (const PaperAccuracy& row : paper_accuracy()) {
    if (row.set != groups.front()->set || !row.reduction) continue;
    const double last = axis_of(curves, 0, "", false).high / 1.05;
    curves.push_back(
        {"paper, at its end", kPaperColor, {{0.0, *row.reduction}, {last, *row.reduction}}});
  }
  frame.x = axis_of(curves, 0, "key frames", false);
  frame.y = axis_of(curves, 1, "reduction ratio", false);
  return plot("reduction_" + groups.front()->set + ".svg",
              "Reduction ratio over the key frames: " + seeds_text(groups) + ".", curves, frame);
}

std::optional<Picture> noise_picture(std::span<const RunGroup> groups, const FigureKind& kind) {
  static constexpr std::array<std::pair<const char*, double>, 3> kNoises = {
      {{"n0", 0.0}, {"n005", 5.0}, {"n02", 20.0}}};
  std::vector<Curve> curves = {paper_curve(kind, kNoises)};
  for (const auto& [set, noise] : kNoises) {
    for (const RunGroup* group : groups_of(groups, set)) {
      const std::optional<Spread> spread = spread_of(*group, kind.member);
      if (!spread || spread->mean <= 0.0) continue;
      auto curve = std::find_if(curves.begin(), curves.end(),
                                [&](const Curve& c) { return c.name == group->variant; });
      if (curve == curves.end()) {
        curves.push_back({group->variant, color_of(curves.size() - 1), {}, 2.0, true});
        curve = std::prev(curves.end());
      }
      curve->points.emplace_back(noise, kind.scale * spread->mean);
    }
  }
  const bool enough = std::any_of(curves.begin() + 1, curves.end(),
                                  [](const Curve& curve) { return curve.points.size() > 1; });
  if (!enough) return std::nullopt;
  PlotFrame frame;
  frame.title = fmt::format("{} over the sensor's noise", kind.key);
  frame.x = axis_of(curves, 0, "noise of the depth, sigma [mm]", false);
  frame.y = axis_of(curves, 1, fmt::format("{}, logarithmic", kind.title), true);
  return plot(fmt::format("noise_{}.svg", kind.key),
              fmt::format("{} over the noise of the depth: the paper's figures and ours, means "
                          "over seeds.",
                          kind.key),
              curves, frame);
}

}  // namespace geomap::logs
