// SPDX-License-Identifier: BSD-3-Clause
#include "rooms_plot.hpp"

#include <algorithm>
#include <array>

#include "logs/plot_frame.hpp"

namespace geomap::bench {
namespace {

using Eigen::Vector2d;
using mapping::SvgCanvas;

// All in pixels.
constexpr double kWidth = 540.0;
constexpr double kMargin = 18.0;
constexpr double kHeight = 220.0;  // of each area of data
constexpr double kLegend = 26.0;

struct Figure {
  const char* name;
  double RoomCost::*value;
  const char* color;
};

constexpr std::array kFigures = {Figure{"blocks visited", &RoomCost::blocks, "#1f5fb4"},
                                 Figure{"candidates visited", &RoomCost::candidates, "#d9661f"},
                                 Figure{"processor time", &RoomCost::total, "#2e8b57"}};

void draw_legend(SvgCanvas& canvas) {
  Vector2d at(kMargin, kMargin);
  for (const Figure& figure : kFigures) {
    canvas.line(at, at + Vector2d(26.0, 0.0), figure.color, 3.0);
    canvas.text(at + Vector2d(32.0, 4.0), figure.name, {});
    at.x() += 160.0;
  }
}

void draw_costs(SvgCanvas& canvas, const logs::PlotFrame& frame, const RoomsRun& run,
                const RoomsWay& way) {
  const std::vector<RoomCost> rows = medians_by_row(run, way);
  for (const Figure& figure : kFigures) {
    const auto point = [&](const RoomCost& cost) {
      return Vector2d(cost.planes, cost.*figure.value / (rows.front().*figure.value));
    };
    for (const RoomCost& room : run.rooms) {
      if (!way.is_comparable(room.room)) continue;
      Vector2d at = point(room);
      at.y() = std::min(at.y(), frame.y.high);
      canvas.circle(frame.to_picture(at), 1.8, {.fill = figure.color, .fill_opacity = 0.45});
    }
    std::vector<Vector2d> course;
    for (const RoomCost& row : rows) course.push_back(point(row));
    logs::draw_curve(canvas, frame, course, figure.color, 2.0);
  }
}

void draw_memory(SvgCanvas& canvas, const logs::PlotFrame& frame, const RoomsRun& run) {
  std::vector<Vector2d> course;
  for (const RoomCost& room : run.rooms) course.emplace_back(room.planes, 1e-6 * room.heap_bytes);
  logs::draw_curve(canvas, frame, course, "#8e44ad", 2.0);
}

}  // namespace

std::string plot_rooms(const RoomsRun& run, const RoomsWay& way) {
  SvgCanvas canvas;
  draw_legend(canvas);
  logs::PlotFrame costs;
  costs.title = "A key frame in a growing map";
  costs.corner = {kMargin + logs::kPlotLeft, kMargin + kLegend + logs::kPlotTop};
  costs.size = {kWidth - logs::kPlotLeft - 2.0 * kMargin, kHeight};
  costs.x = {0.0, 1.02 * run.planes, "planes in the map"};
  costs.y = {0.0, 1.5, "relative to the first row of rooms"};
  draw_frame(canvas, costs);
  draw_costs(canvas, costs, run, way);

  logs::PlotFrame memory = costs;
  memory.title = "Memory";
  memory.corner.y() += kHeight + logs::kPlotBottom + logs::kPlotTop;
  memory.y = {0.0, 1.05e-6 * run.rooms.back().heap_bytes, "in use [MB]"};
  draw_frame(canvas, memory);
  draw_memory(canvas, memory, run);
  const double height = memory.corner.y() + kHeight + logs::kPlotBottom + 4.0;
  return canvas.finish({kWidth, height}, costs.title);
}

}  // namespace geomap::bench
