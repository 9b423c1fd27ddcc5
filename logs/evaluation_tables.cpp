// SPDX-License-Identifier: BSD-3-Clause
#include "logs/evaluation_tables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "logs/evaluation_cells.hpp"
#include "logs/paper_results.hpp"

namespace geomap::logs {
namespace {

std::vector<const PaperAccuracy*> paper_rows(std::string_view set) {
  std::vector<const PaperAccuracy*> rows;
  for (const PaperAccuracy& row : paper_accuracy()) {
    if (row.set == set) rows.push_back(&row);
  }
  return rows;
}

std::optional<double> paper_value(const PaperAccuracy& row, const FigureKind& kind) {
  if (kind.member == &AccuracyFigures::d_angle) return row.d_angle;
  if (kind.member == &AccuracyFigures::d_dist) return row.d_dist;
  if (kind.member == &AccuracyFigures::rms_p) return row.rms_p;
  if (kind.member == &AccuracyFigures::reduction_ratio) return row.reduction;
  return std::nullopt;
}

// The reduction ratio is no error: more planes for a feature only mean more looks at it.
bool is_better(const FigureKind& kind, const std::optional<Spread>& ours,
               std::span<const PaperAccuracy* const> paper) {
  if (!ours || paper.empty() || kind.member == &AccuracyFigures::reduction_ratio) return false;
  return std::all_of(paper.begin(), paper.end(), [&](const PaperAccuracy* row) {
    const std::optional<double> theirs = paper_value(*row, kind);
    return theirs && ours->mean < *theirs;
  });
}

Row paper_row(const PaperAccuracy& paper) {
  Row row{{{fmt::format("paper, {}", paper.name)}, {"-"}}, RowKind::kReference};
  for (const FigureKind& kind : paper_figures()) {
    row.cells.push_back({number_text(paper_value(paper, kind), kind.scale, kind.decimals)});
  }
  return row;
}

Row group_row(const RunGroup& group, std::span<const FigureKind> kinds,
              std::span<const PaperAccuracy* const> paper) {
  Row row{{{group.variant}, {std::to_string(group.runs.size())}}, RowKind::kPlain};
  for (const FigureKind& kind : kinds) {
    const std::optional<Spread> spread = spread_of(group, kind.member);
    Cell cell = spread_cell(spread, kind);
    cell.strong = is_better(kind, spread, paper);
    row.cells.push_back(std::move(cell));
  }
  return row;
}

Table table_of(std::span<const FigureKind> kinds) {
  Table table;
  table.columns = {{"run", false}, {"seeds"}};
  for (const FigureKind& kind : kinds) table.columns.push_back({kind.title});
  return table;
}

// A heading where another set begins; true then.
bool begin_set(Table& table, std::string& last, std::string_view set) {
  if (last == set) return false;
  last = set;
  table.rows.push_back({{{set_title(set)}}, RowKind::kGroup});
  return true;
}

}  // namespace

Table accuracy_table(std::span<const RunGroup> groups) {
  Table table = table_of(paper_figures());
  std::string last;
  for (const RunGroup& group : groups) {
    const auto paper = paper_rows(group.set);
    if (paper.empty()) continue;
    if (begin_set(table, last, group.set)) {
      for (const PaperAccuracy* row : paper) table.rows.push_back(paper_row(*row));
    }
    table.rows.push_back(group_row(group, paper_figures(), paper));
  }
  return table;
}

Table further_sets_table(std::span<const RunGroup> groups) {
  Table table = table_of(paper_figures());
  std::string last;
  for (const RunGroup& group : groups) {
    if (!paper_rows(group.set).empty()) continue;
    begin_set(table, last, group.set);
    table.rows.push_back(group_row(group, paper_figures(), {}));
  }
  return table;
}

Table coverage_table(std::span<const RunGroup> groups) {
  Table table = table_of(further_figures());
  std::string last;
  for (const RunGroup& group : groups) {
    begin_set(table, last, group.set);
    table.rows.push_back(group_row(group, further_figures(), {}));
  }
  return table;
}

Table plane_table(const RunGroup& group) {
  Table table;
  table.caption = fmt::format("{}, {}", set_title(group.set), group.variant);
  table.columns = {{"plane", false}, {"seen [m²]"}, {"features"}};
  const auto kinds = paper_figures().first(5);  // a plane has no reduction ratio
  for (const FigureKind& kind : kinds) table.columns.push_back({kind.title});
  const FigureKind& iou = figure_kind("area_iou");
  table.columns.push_back({iou.title});
  for (const PaperAccuracy* paper : paper_rows(group.set)) {
    Row row{{{fmt::format("paper, {}: mean", paper->name)}, {"-"}, {"-"}}, RowKind::kReference};
    for (const FigureKind& kind : kinds) {
      row.cells.push_back({number_text(paper_value(*paper, kind), kind.scale, kind.decimals)});
    }
    row.cells.push_back({"-"});
    table.rows.push_back(row);
    if (!paper->rms_p_part) continue;
    for (Cell& cell : row.cells) cell.text = "-";
    row.cells[0].text = fmt::format("paper, {}: {}", paper->name, paper->part);
    row.cells[7].text = number_text(paper->rms_p_part, 1e3, 1);
    table.rows.push_back(row);
  }
  for (const PlaneStatistics& plane : planes_of(group)) {
    Row row{{{plane.name}, {number_text(plane.results.front()->visible_area, 1.0, 2)}},
            RowKind::kPlain};
    const std::optional<Spread> features = plane.features();
    row.cells.push_back(spread_cell(features, 1.0, features->min == features->max ? 0 : 1));
    if (features->min == 0.0) row.cells.back().tone = CellTone::kBad;
    for (const FigureKind& kind : kinds) {
      row.cells.push_back(spread_cell(plane.spread(kind.member), kind));
    }
    row.cells.push_back(spread_cell(plane.spread(iou.member), iou));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table bounds_table(std::span<const BoundResult> results) {
  Table table;
  table.columns = {{"figure", false}, {"run", false},        {"bound"},
                   {"worst"},         {"worst seed", false}, {"", false}};
  std::string last;
  for (const BoundResult& result : results) {
    const FigureKind& kind = figure_kind(result.bound.figure);
    // One digit more than elsewhere: what misses a bound by little must not read like it.
    const auto number = [&](std::optional<double> value) {
      return number_text(value, kind.scale, kind.decimals + 1);
    };
    const Cell verdict{result.met ? "met" : "MISSED", "", !result.met,
                       result.met ? CellTone::kGood : CellTone::kBad};
    begin_set(table, last, result.bound.set);
    table.rows.push_back(
        {{{kind.title},
          {result.variant},
          {fmt::format("{} {}", words_of(result.bound.kind), number(result.bound.value))},
          {number(result.worst)},
          {result.worst_seed},
          verdict},
         RowKind::kPlain});
  }
  return table;
}

}  // namespace geomap::logs
