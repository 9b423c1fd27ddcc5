// SPDX-License-Identifier: BSD-3-Clause
#include "logs/evaluation_costs.hpp"

#include <fmt/format.h>

#include "logs/evaluation_cells.hpp"
#include "logs/paper_results.hpp"

namespace geomap::logs {
namespace {

using Groups = std::span<const RunGroup* const>;

struct StageRow {
  const char* title;
  std::vector<const char*> stages;  // of report.json, added
  std::optional<double> paper;      // [s]
};

std::vector<StageRow> stage_rows() {
  const PaperTimes paper;
  return {{"decoding", {"decode"}, {}},
          {"registration", {"registration"}, paper.registration},
          {"plane extraction with outlines", {"extraction", "hull"}, paper.extraction},
          {"- of which planes", {"extraction"}, {}},
          {"- of which outlines", {"hull"}, {}},
          {"merging", {"merging"}, paper.merging},
          {"total", {"total"}, paper.total}};
}

std::optional<Spread> time_spread(const RunGroup& group, const std::vector<const char*>& stages,
                                  double StageSummary::*statistic) {
  return spread_of(group, [&](const Run& run) -> std::optional<double> {
    double sum = 0.0;
    for (const char* stage : stages) {
      const auto found = run.report.stages.find(stage);
      if (found == run.report.stages.end()) return std::nullopt;
      sum += found->second.*statistic;
    }
    return sum;
  });
}

Cell time_cell(const RunGroup& group, const StageRow& row) {
  const std::optional<Spread> mean = time_spread(group, row.stages, &StageSummary::mean);
  if (!mean) return {"-"};
  Cell cell{number_text(mean->mean, 1e3, 1)};
  cell.strong = row.paper && mean->mean < *row.paper;
  if (row.stages.size() > 1) return cell;  // percentiles do not add
  cell.note =
      fmt::format("{:.1f}, {:.1f}", 1e3 * time_spread(group, row.stages, &StageSummary::p50)->mean,
                  1e3 * time_spread(group, row.stages, &StageSummary::p95)->mean);
  return cell;
}

// One figure of the reports, a column for each group.
template <typename Figure>
Row report_row(Groups groups, const char* title, const std::string& paper, const Figure& figure) {
  Row row{{{title}, {paper}}, RowKind::kPlain};
  for (const RunGroup* group : groups) row.cells.push_back(figure(*group));
  return row;
}

Cell count_cell(const RunGroup& group, int RunReport::*count) {
  const auto spread = spread_of(group, [&](const Run& run) -> std::optional<double> {
    return static_cast<double>(run.report.*count);
  });
  return spread_cell(spread, 1.0, 0);
}

double mean_bytes(const RunGroup& group, std::int64_t RunReport::*bytes) {
  return spread_of(group,
                   [&](const Run& run) -> std::optional<double> {
                     return static_cast<double>(run.report.*bytes);
                   })
      ->mean;
}

Table table_of(Groups groups, const char* first) {
  Table table;
  table.columns = {{first, false}, {"paper"}};
  for (const RunGroup* group : groups) table.columns.push_back({group->variant});
  return table;
}

Cell share_cell(const RunGroup& group, std::int64_t RunReport::*bytes, double paper_share) {
  const double part = mean_bytes(group, bytes);
  const double raw = mean_bytes(group, &RunReport::raw_bytes);
  return {bytes_text(part), percent_text(part, raw), raw > 0.0 && part / raw < paper_share};
}

}  // namespace

Table time_table(Groups groups) {
  const PaperTimes paper;
  Table table = table_of(groups, "time per key frame [ms], mean (p50, p95)");
  for (const StageRow& stage : stage_rows()) {
    table.rows.push_back(
        report_row(groups, stage.title, number_text(stage.paper, 1e3, 0),
                   [&](const RunGroup& group) { return time_cell(group, stage); }));
  }
  table.rows.push_back(
      report_row(groups, "key frames", std::to_string(paper.keyframes),
                 [](const RunGroup& group) { return count_cell(group, &RunReport::keyframes); }));
  table.rows.push_back(report_row(
      groups, "planes extracted", std::to_string(paper.planes),
      [](const RunGroup& group) { return count_cell(group, &RunReport::planes_extracted); }));
  table.rows.push_back(
      report_row(groups, "runs", std::to_string(paper.runs),
                 [](const RunGroup& group) { return Cell{std::to_string(group.runs.size())}; }));
  return table;
}

Table reduction_table(Groups groups) {
  const PaperReduction paper;
  Table table = table_of(groups, "data");
  const auto paper_text = [&](double bytes) {
    return fmt::format("{}, {}", bytes_text(bytes), percent_text(bytes, paper.raw_bytes));
  };
  table.rows.push_back(
      report_row(groups, "key frames", std::to_string(paper.keyframes),
                 [](const RunGroup& group) { return count_cell(group, &RunReport::keyframes); }));
  table.rows.push_back(report_row(groups, "raw, 12 bytes a pixel of each key frame",
                                  bytes_text(paper.raw_bytes), [](const RunGroup& group) {
                                    return Cell{
                                        bytes_text(mean_bytes(group, &RunReport::raw_bytes))};
                                  }));
  table.rows.push_back(report_row(groups, "point map", paper_text(paper.point_map_bytes),
                                  [&](const RunGroup& group) {
                                    return share_cell(group, &RunReport::point_map_bytes,
                                                      paper.point_map_bytes / paper.raw_bytes);
                                  }));
  table.rows.push_back(report_row(groups, "geometric map, 12 bytes a vertex and 16 a polygon",
                                  paper_text(paper.map_bytes), [&](const RunGroup& group) {
                                    return share_cell(group, &RunReport::map_bytes,
                                                      paper.map_bytes / paper.raw_bytes);
                                  }));
  return table;
}

std::optional<Spread> total_time(const RunGroup& group) {
  return time_spread(group, {"total"}, &StageSummary::mean);
}

std::optional<Spread> map_share(const RunGroup& group) {
  return spread_of(group, [](const Run& run) -> std::optional<double> {
    if (run.report.raw_bytes == 0) return std::nullopt;
    return static_cast<double>(run.report.map_bytes) / static_cast<double>(run.report.raw_bytes);
  });
}

}  // namespace geomap::logs
