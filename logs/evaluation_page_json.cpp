// SPDX-License-Identifier: BSD-3-Clause
#include "logs/evaluation_page_json.hpp"

#include <nlohmann/json.hpp>
#include <set>

#include "logs/paper_results.hpp"

namespace geomap::logs {
namespace {

using nlohmann::ordered_json;

ordered_json to_json(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json();
}

ordered_json to_json(const std::optional<Spread>& spread) {
  if (!spread) return {};
  return {
      {"mean", spread->mean}, {"min", spread->min}, {"max", spread->max}, {"count", spread->count}};
}

ordered_json planes_json(const RunGroup& group) {
  ordered_json planes = ordered_json::object();
  for (const PlaneStatistics& plane : planes_of(group)) {
    ordered_json& json = planes[plane.name];
    json["features"] = to_json(plane.features());
    for (const FigureKind& kind : paper_figures().first(5)) {
      json[kind.key] = to_json(plane.spread(kind.member));
    }
    json["area_iou"] = to_json(plane.spread(&AccuracyFigures::area_iou));
  }
  return planes;
}

// Of a whole number of the reports.
template <typename Number>
ordered_json report_spread(const RunGroup& group, Number RunReport::*number) {
  return to_json(spread_of(group, [&](const Run& run) -> std::optional<double> {
    return static_cast<double>(run.report.*number);
  }));
}

ordered_json stages_json(const RunGroup& group) {
  std::set<std::string> names;
  for (const Run* run : group.runs) {
    for (const auto& [name, times] : run->report.stages) names.insert(name);
  }
  ordered_json stages = ordered_json::object();
  for (const std::string& name : names) {
    const auto spread = [&](double StageSummary::*statistic) {
      return to_json(spread_of(group, [&](const Run& run) -> std::optional<double> {
        const auto found = run.report.stages.find(name);
        if (found == run.report.stages.end()) return std::nullopt;
        return found->second.*statistic;
      }));
    };
    stages[name] = {{"mean", spread(&StageSummary::mean)},
                    {"p50", spread(&StageSummary::p50)},
                    {"p95", spread(&StageSummary::p95)}};
  }
  return stages;
}

ordered_json group_json(const RunGroup& group) {
  ordered_json json;
  for (const Run* run : group.runs) json["seeds"].push_back(run->seed);
  for (const auto& kinds : {paper_figures(), further_figures()}) {
    for (const FigureKind& kind : kinds) json[kind.key] = to_json(spread_of(group, kind.member));
  }
  json["keyframes"] = report_spread(group, &RunReport::keyframes);
  json["planes_extracted"] = report_spread(group, &RunReport::planes_extracted);
  json["map_features"] = report_spread(group, &RunReport::map_features);
  json["bytes"] = {{"raw", report_spread(group, &RunReport::raw_bytes)},
                   {"point_map", report_spread(group, &RunReport::point_map_bytes)},
                   {"map", report_spread(group, &RunReport::map_bytes)}};
  json["stage_seconds"] = stages_json(group);
  json["planes"] = planes_json(group);
  return json;
}

ordered_json bound_json(const BoundResult& result) {
  return {{"set", result.bound.set},         {"variant", result.variant},
          {"figure", result.bound.figure},   {"kind", words_of(result.bound.kind)},
          {"value", result.bound.value},     {"worst", to_json(result.worst)},
          {"worst_seed", result.worst_seed}, {"met", result.met}};
}

ordered_json paper_json() {
  ordered_json rows = ordered_json::array();
  for (const PaperAccuracy& row : paper_accuracy()) {
    rows.push_back({{"set", row.set},
                    {"source", row.source},
                    {"d_angle", row.d_angle},
                    {"d_dist", row.d_dist},
                    {"rms_p", row.rms_p},
                    {"reduction_ratio", to_json(row.reduction)}});
  }
  const PaperTimes times;
  const PaperReduction data;
  return {{"accuracy", rows},
          {"stage_seconds",
           {{"source", "Table 4"},
            {"registration", times.registration},
            {"extraction", times.extraction},
            {"merging", times.merging},
            {"total", times.total},
            {"runs", times.runs},
            {"keyframes", times.keyframes},
            {"planes_extracted", times.planes}}},
          {"bytes",
           {{"source", "Table 5"},
            {"keyframes", data.keyframes},
            {"raw", data.raw_bytes},
            {"point_map", data.point_map_bytes},
            {"map", data.map_bytes}}}};
}

}  // namespace

std::string evaluation_page_json(const RunCollection& collection, std::span<const RunGroup> groups,
                                 std::span<const BoundResult> bounds) {
  ordered_json json;
  json["runs"] = collection.runs.size();
  json["missing"] = collection.missing;
  json["sets"] = ordered_json::object();
  for (const RunGroup& group : groups) json["sets"][group.set][group.variant] = group_json(group);
  json["bounds"] = ordered_json::array();
  for (const BoundResult& result : bounds) json["bounds"].push_back(bound_json(result));
  json["paper"] = paper_json();
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace geomap::logs
