// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/export_svg_legend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "mapping/export_svg_style.hpp"

namespace geomap::mapping {
namespace {

constexpr double kTextSize = 12.0;          // [px]
constexpr double kLongestScaleBar = 170.0;  // [px]

// The largest of 1, 2, 5 times a power of ten [m] that is drawn no longer than the limit.
double round_length(double scale) {
  const double longest = kLongestScaleBar / scale;
  const double power = std::pow(10.0, std::floor(std::log10(longest)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= longest) return digit * power;
  }
  return power;
}

double entry_width(const LegendEntry& entry) { return 38.0 + text_width(entry.text, kTextSize); }

}  // namespace

double scale_bar_width(double scale) { return round_length(scale) * scale + 70.0; }

void draw_scale_bar(SvgCanvas& canvas, const Eigen::Vector2d& at, double scale) {
  const double length = round_length(scale);
  const Eigen::Vector2d end = at + Eigen::Vector2d(length * scale, 0.0);
  const Eigen::Vector2d tick(0.0, 5.0);
  const std::string_view ink = "#1f2933";
  canvas.line(at, end, ink, 1.6);
  canvas.line(at - tick, at + tick, ink, 1.6);
  canvas.line(end - tick, end + tick, ink, 1.6);
  const std::string text = length >= 1.0    ? fmt::format("{:.0f} m", length)
                           : length >= 0.01 ? fmt::format("{:.0f} cm", 100.0 * length)
                                            : fmt::format("{:.0f} mm", 1000.0 * length);
  canvas.text(end + Eigen::Vector2d(10.0, 4.0), text, {.size = kTextSize});
}

std::vector<LegendEntry> legend_of(const MapSnapshot& map, const std::vector<SvgPanel>& panels) {
  std::set<Orientation> present;
  for (const MapFeature& feature : map.features) present.insert(orientation_of(feature));
  std::vector<LegendEntry> entries;
  for (const Orientation orientation : kOrientations) {
    if (!present.contains(orientation)) continue;
    entries.push_back({.colors = orientation_colors(orientation),
                       .text = std::string(orientation_name(orientation))});
  }
  const bool any_behind = std::any_of(panels.begin(), panels.end(), [](const SvgPanel& panel) {
    return std::any_of(panel.features.begin(), panel.features.end(), is_seen_from_behind);
  });
  const Rgb grey = {123, 135, 148};
  if (any_behind) {
    entries.push_back({.colors = {grey, grey}, .text = "pale: seen from behind", .opacity = 0.12});
  }
  const bool any_held = std::any_of(map.features.begin(), map.features.end(),
                                    [](const MapFeature& feature) { return feature.is_held(); });
  if (any_held) {
    entries.push_back(
        {.colors = {grey, grey}, .text = "bold: held", .opacity = 0.3, .outline = 3.0});
  }
  if (!panels.front().deleted.empty()) {
    entries.push_back(
        {.colors = {grey, grey}, .text = "dashed: deleted", .opacity = 0.0, .is_deleted = true});
  }
  return entries;
}

double legend_width(const std::vector<LegendEntry>& entries) {
  double width = 0.0;
  for (const LegendEntry& entry : entries) width += entry_width(entry);
  return width;
}

void draw_legend(SvgCanvas& canvas, Eigen::Vector2d at, const std::vector<LegendEntry>& entries) {
  for (const LegendEntry& entry : entries) {
    const Eigen::Vector2d corner = at - Eigen::Vector2d(0.0, 6.0);
    for (std::size_t half = 0; half < 2; ++half) {
      canvas.rectangle(corner + Eigen::Vector2d(9.0 * static_cast<double>(half), 0.0), {9.0, 12.0},
                       {.fill = to_hex(entry.colors[half]), .fill_opacity = entry.opacity});
    }
    canvas.rectangle(corner, {18.0, 12.0},
                     {.stroke = entry.is_deleted ? std::string(kDeletedColor)
                                                 : to_hex(outline_color(entry.colors[0])),
                      .stroke_width = entry.outline,
                      .dashed = entry.is_deleted});
    canvas.text(at + Eigen::Vector2d(24.0, 4.0), entry.text, {.size = kTextSize});
    at.x() += entry_width(entry);
  }
}

}  // namespace geomap::mapping
