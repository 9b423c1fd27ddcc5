// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/export_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "mapping/export_svg_canvas.hpp"
#include "mapping/export_svg_legend.hpp"
#include "mapping/export_svg_panel.hpp"

namespace geomap::mapping {
namespace {

// All in pixels.
constexpr double kMargin = 32.0;
constexpr double kTitleHeight = 66.0;
constexpr double kFooterGap = 30.0;
constexpr double kFooterRow = 26.0;
constexpr double kGap = 34.0;  // between panels
constexpr double kTitleSize = 20.0;
constexpr double kSubtitleSize = 13.0;
constexpr double kSmallestBox = 0.05;  // [m], keeps the scale of a tiny map in bounds

using Columns = std::vector<std::vector<std::size_t>>;  // indices of panels, top down

std::string counts_text(const MapSnapshot& map) {
  std::size_t vertices = 0;
  double area = 0.0;
  for (const MapFeature* feature : sorted_by_id(map.features)) {
    vertices += geometry::vertex_count(feature->surface.polygon);
    area += geometry::area(feature->surface.polygon);
  }
  return fmt::format("{} feature{} · {} vertices · {:.2f} m²", map.features.size(),
                     map.features.size() == 1 ? "" : "s", vertices, area);
}

Eigen::AlignedBox2d view_box(const SvgPanel& panel,
                             const std::optional<Eigen::AlignedBox3d>& extent) {
  Eigen::AlignedBox2d box;
  for (const ProjectedFeature& feature : panel.features) box.extend(feature.box);
  for (const ProjectedFeature& deleted : panel.deleted) box.extend(deleted.box);
  if (extent.has_value() && !extent->isEmpty()) {
    for (int corner = 0; corner < 8; ++corner) {
      box.extend(
          panel.axes.project(extent->corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner))));
    }
  }
  const Eigen::Vector2d half = box.sizes().cwiseMax(kSmallestBox) / 2.0;
  return {box.center() - half, box.center() + half};
}

std::vector<MapFeature> deleted_of(const MapSnapshot& map) {
  std::vector<MapFeature> deleted;
  for (const Veto& veto : map.vetoes) {
    if (veto.cause == VetoCause::kDeleted) deleted.push_back(veto.feature);
  }
  return deleted;
}

std::vector<SvgPanel> make_panels(const MapSnapshot& map, const std::vector<MapFeature>& deleted,
                                  const SvgOptions& options, double heading) {
  const double turn = options.turn.value_or(oblique_turn(map.features, heading));
  std::vector<SvgPanel> panels;
  for (const SvgView view : options.views) {
    SvgPanel& panel = panels.emplace_back();
    panel.view = view;
    panel.axes = view_axes(view, heading, turn);
    panel.features = project_features(map.features, panel.axes);
    panel.deleted = project_features(deleted, panel.axes);
    panel.box = view_box(panel, options.extent);
  }
  return panels;
}

// The arrangements tried: the oblique views beside the others, all in one column, all in one row.
std::vector<Columns> arrangements(const std::vector<SvgPanel>& panels) {
  Columns beside(2);
  Columns column(1);
  Columns row;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    beside[panels[i].view == SvgView::kOblique ? 1 : 0].push_back(i);
    column[0].push_back(i);
    row.push_back({i});
  }
  std::erase_if(beside, [](const auto& panels_of_column) { return panels_of_column.empty(); });
  return {beside, column, row};
}

// Largest common scale [px/m] at which the arrangement keeps to the wanted size.
double fitting_scale(const std::vector<SvgPanel>& panels, const Columns& columns,
                     const SvgOptions& options) {
  double fixed_width = -kGap;
  double width = 0.0;
  double scale = std::numeric_limits<double>::max();
  for (const auto& column : columns) {
    double fixed_height = -kGap;
    double height = 0.0;
    double widest = 0.0;
    for (const std::size_t i : column) {
      fixed_height += kPanelCaption + kGap;
      height += panels[i].box.sizes().y();
      widest = std::max(widest, panels[i].box.sizes().x());
    }
    fixed_width += kPanelGutter + kGap;
    width += widest;
    scale = std::min(scale, std::max(options.max_height - fixed_height, 1.0) / height);
  }
  return std::min(scale, std::max(options.max_width - fixed_width, 1.0) / width);
}

// Places the panels and returns the size they take [px].
Eigen::Vector2d arrange(std::vector<SvgPanel>& panels, const SvgOptions& options) {
  Columns best;
  double scale = 0.0;
  for (const Columns& columns : arrangements(panels)) {
    const double fitting = fitting_scale(panels, columns, options);
    if (fitting <= scale) continue;
    scale = fitting;
    best = columns;
  }
  Eigen::Vector2d corner(kMargin, kMargin + kTitleHeight);
  Eigen::Vector2d size = Eigen::Vector2d::Zero();
  for (const auto& column : best) {
    double widest = 0.0;
    Eigen::Vector2d next = corner;
    for (const std::size_t i : column) {
      panels[i].scale = scale;
      panels[i].corner = next;
      next.y() += panels[i].size().y() + kGap;
      widest = std::max(widest, panels[i].size().x());
    }
    corner.x() += widest + kGap;
    size = size.cwiseMax(Eigen::Vector2d(corner.x(), next.y()) -
                         Eigen::Vector2d(kMargin + kGap, kMargin + kTitleHeight + kGap));
  }
  return size;
}

void draw_title(SvgCanvas& canvas, const std::string& title, const std::string& subtitle) {
  canvas.text({kMargin, kMargin + 18.0}, title, {.size = kTitleSize, .bold = true});
  canvas.text({kMargin, kMargin + 40.0}, subtitle, {.size = kSubtitleSize, .color = "#52606d"});
}

std::string empty_sheet(const std::string& title, const std::string& subtitle) {
  SvgCanvas canvas;
  draw_title(canvas, title, subtitle);
  canvas.text({280.0, 150.0}, "empty map",
              {.size = 16.0, .color = "#7b8794", .anchor = TextAnchor::kMiddle});
  return canvas.finish({560.0, 220.0}, title);
}

}  // namespace

std::string to_svg(const MapSnapshot& map, const SvgOptions& options) {
  if (options.views.empty()) throw std::invalid_argument("to_svg: no views");
  if (!(options.max_width > 0.0) || !(options.max_height > 0.0)) {
    throw std::invalid_argument("to_svg: the size is not positive");
  }
  const std::string title = clean_text(options.title);
  const std::string subtitle = fmt::format("revision {} · {}", map.revision, counts_text(map));
  const double heading = options.heading.value_or(front_heading(map.features));
  const std::vector<MapFeature> deleted = deleted_of(map);
  std::vector<SvgPanel> panels = make_panels(map, deleted, options, heading);
  if (panels.front().features.empty() && deleted.empty()) return empty_sheet(title, subtitle);

  const Eigen::Vector2d drawings = arrange(panels, options);
  const double scale = panels.front().scale;
  const std::vector<LegendEntry> legend = legend_of(map, panels);
  const double bar_width = scale_bar_width(scale);
  const bool one_row = bar_width + legend_width(legend) <= drawings.x();
  const double inner_width =
      std::max({drawings.x(), text_width(title, kTitleSize), text_width(subtitle, kSubtitleSize),
                legend_width(legend), bar_width});

  SvgCanvas canvas;
  draw_title(canvas, title, subtitle);
  PanelStyle style{
      .heading = heading, .labels = options.labels, .highlighted = options.highlighted};
  std::sort(style.highlighted.begin(), style.highlighted.end());
  for (const SvgPanel& panel : panels) draw_panel(canvas, panel, style);
  const double footer = kMargin + kTitleHeight + drawings.y() + kFooterGap;
  draw_scale_bar(canvas, {kMargin, footer}, scale);
  const Eigen::Vector2d legend_at(one_row ? kMargin + bar_width : kMargin,
                                  one_row ? footer : footer + kFooterRow);
  draw_legend(canvas, legend_at, legend);
  return canvas.finish({inner_width + 2.0 * kMargin, legend_at.y() + kMargin}, title);
}

}  // namespace geomap::mapping
