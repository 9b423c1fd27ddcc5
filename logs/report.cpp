// SPDX-License-Identifier: BSD-3-Clause
#include "logs/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "geometry/polygon.hpp"
#include "logs/map_metrics.hpp"
#include "mapping/export_features.hpp"
#include "mapping/export_file.hpp"

namespace geomap::logs {
namespace {

using Stage = std::pair<const char*, std::function<double(const StageTimes&)>>;

const std::vector<Stage>& stages() {
  static const std::vector<Stage> all = {
      {"decode", [](const StageTimes& t) { return t.decode; }},
      {"registration", [](const StageTimes& t) { return t.registration; }},
      {"extraction", [](const StageTimes& t) { return t.extraction; }},
      {"hull", [](const StageTimes& t) { return t.hull; }},
      {"merging", [](const StageTimes& t) { return t.merging; }},
      {"total", [](const StageTimes& t) { return t.total(); }},
  };
  return all;
}

Summary summary_of(const Report& report, const Stage& stage) {
  std::vector<double> values;
  for (const StageTimes& times : report.times) values.push_back(stage.second(times));
  return summarize(std::move(values));
}

int planes_extracted(const Report& report) {
  return std::accumulate(report.keyframes.begin(), report.keyframes.end(), 0,
                         [](int sum, const KeyframeRecord& k) { return sum + k.planes; });
}

// Of the accepted key frames that were aligned: median of one of their figures.
template <typename Figure>
double median_of(const Report& report, const Figure& figure) {
  std::vector<double> values;
  for (const KeyframeRecord& keyframe : report.keyframes) {
    const auto& alignment = keyframe.registration.alignment;
    if (alignment) values.push_back(static_cast<double>(figure(*alignment)));
  }
  return summarize(std::move(values)).p50;
}

std::int64_t unknown_views(const Report& report) {
  return std::count_if(report.keyframes.begin(), report.keyframes.end(), [](const auto& keyframe) {
    return keyframe.registration.reason == perception::RegistrationReason::kUnknownView;
  });
}

nlohmann::ordered_json registration_json(const Report& report) {
  using perception::Alignment;
  return {{"lost", report.tracking.lost},
          {"relocalised", report.tracking.relocalised},
          {"lost_at_end", report.lost_at_end},
          {"unknown_views", unknown_views(report)},
          {"odometry_relinked", report.tracking.relinked},
          {"time_went_back", report.tracking.time_went_back},
          {"depth_corrections", report.tracking.corrections},
          {"pose_jumps", report.poses.jumps},
          {"pose_restarts", report.poses.restarts},
          {"pose_out_of_order", report.poses.out_of_order},
          {"pose_invalid", report.poses.invalid},
          {"rms", median_of(report, [](const Alignment& a) { return a.rms; })},
          {"overlap", median_of(report, [](const Alignment& a) { return a.overlap; })},
          {"conditioning", median_of(report, [](const Alignment& a) { return a.conditioning; })}};
}

// What the operator of a robot would want to know of the way.
std::string tracking_rows(const Report& report) {
  std::string text;
  const auto row = [&](const char* what, std::int64_t count) {
    if (count > 0) text += fmt::format("| {} | {} |\n", what, count);
  };
  row("times the camera was lost", report.tracking.lost);
  row("times it was found again", report.tracking.relocalised);
  if (report.lost_at_end) text += "| at the end | lost |\n";
  row("key frames that the map knew too little of: posed by odometry", unknown_views(report));
  row("odometry tied in anew after a break", report.tracking.relinked);
  row("operators' edits done again", report.edits);
  row("frames older than the one before", report.tracking.time_went_back);
  row("jumps of POSE", report.poses.jumps);
  row("restarts of POSE", report.poses.restarts);
  row("POSE out of order, ignored", report.poses.out_of_order);
  row("POSE not finite or not rigid, ignored", report.poses.invalid);
  row("improvements of the depth correction", report.tracking.corrections);
  const double rms = median_of(report, [](const perception::Alignment& a) { return a.rms; });
  if (rms > 0.0) text += fmt::format("| median rms of an alignment | {:.1f} mm |\n", 1e3 * rms);
  return text;
}

// Of each key frame: how the map had grown (the paper's Figure 6), and what the key frame cost.
nlohmann::ordered_json growth_json(const Report& report) {
  const auto of_each = [&](auto figure) {
    auto values = nlohmann::ordered_json::array();
    for (const KeyframeRecord& keyframe : report.keyframes) values.push_back(figure(keyframe));
    return values;
  };
  return {
      {"planes_extracted", of_each([sum = 0](const auto& k) mutable { return sum += k.planes; })},
      {"map_features", of_each([](const auto& k) { return k.map_features; })},
      {"blocks_visited", of_each([](const auto& k) { return k.registration.blocks_visited; })},
      {"candidates_visited", of_each([](const auto& k) { return k.candidates; })},
      {"registration_seconds", of_each([](const auto& k) { return k.times.registration; })},
      {"merging_seconds", of_each([](const auto& k) { return k.times.merging; })},
      {"total_seconds", of_each([](const auto& k) { return k.times.total(); })}};
}

nlohmann::ordered_json to_json(const Report& report) {
  nlohmann::ordered_json json;
  const DataReduction& reduction = report.reduction;
  json["log"] = report.log;
  if (!report.camera.empty()) json["camera"] = report.camera;
  json["extractor"] = report.extractor;
  json["merge"] = report.merge_mode;
  json["frames"] = report.frames;
  json["edits"] = report.edits;
  json["keyframes"] = report.keyframes.size();
  json["keyframes_rejected"] = report.rejected;
  json["registration"] = registration_json(report);
  json["messages_refused"] = report.refused;
  json["sequence_gaps"] = report.sequence_gaps;
  json["log_damaged"] = report.log_damaged;
  json["planes_extracted"] = planes_extracted(report);
  json["map_features"] = report.map.features.size();
  json["growth"] = growth_json(report);
  json["map_duplicates"] = find_duplicates(report.map.features).size();
  json["map_vertices"] = reduction.map_vertices;
  json["bytes"] = {{"raw", reduction.raw_bytes},
                   {"point_map", reduction.point_map_bytes},
                   {"map", reduction.map_bytes},
                   {"map_serialised", reduction.map_bytes_serialised}};
  json["point_map_points"] = reduction.point_map_points;
  for (const Stage& stage : stages()) {
    const Summary s = summary_of(report, stage);
    json["stage_seconds"][stage.first] = {
        {"mean", s.mean}, {"p50", s.p50}, {"p95", s.p95}, {"max", s.max}};
  }
  json["wall_seconds"] = report.wall_seconds;
  json["map_hash"] = report.map.hash;
  json["map_revision"] = report.map.revision;
  json["git_revision"] = report.git_revision;
  json["config_hash"] = report.config_hash;
  return json;
}

std::string size_text(std::int64_t bytes) {
  const auto size = static_cast<double>(bytes);
  if (size < 1e4) return fmt::format("{} B", bytes);
  if (size < 1e6) return fmt::format("{:.1f} kB", size / 1e3);
  return fmt::format("{:.1f} MB", size / 1e6);
}

std::string share_text(std::int64_t part, std::int64_t whole) {
  if (whole == 0) return "-";
  return fmt::format("{:.4g} %", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

std::string overview(const Report& report) {
  const auto features = static_cast<double>(report.map.features.size());
  const int extracted = planes_extracted(report);
  std::string text = "| | |\n|---|---|\n";
  text += fmt::format("| frames read | {} |\n", report.frames);
  text += fmt::format("| key frames in the map | {} |\n", report.keyframes.size());
  for (const auto& [reason, count] : report.rejected) {
    text += fmt::format("| frames rejected: {} | {} |\n", reason, count);
  }
  text += tracking_rows(report);
  for (const auto& [channel, reasons] : report.refused) {
    for (const auto& [reason, count] : reasons) {
      text += fmt::format("| messages refused on {}: {} | {} |\n", channel, reason, count);
    }
  }
  if (report.sequence_gaps > 0) {
    text += fmt::format("| frames missing by sequence number | {} |\n", report.sequence_gaps);
  }
  if (!report.camera.empty()) text += fmt::format("| depth corrected by | {} |\n", report.camera);
  if (report.log_damaged) text += "| log | damaged or cut short; readable events were used |\n";
  text += fmt::format("| planes extracted | {} |\n", extracted);
  text += fmt::format("| features in the map | {} |\n", report.map.features.size());
  if (features > 0) {
    text += fmt::format("| extracted planes per feature | {:.1f} |\n", extracted / features);
  }
  text +=
      fmt::format("| surfaces mapped twice | {} |\n", find_duplicates(report.map.features).size());
  text += fmt::format("| extractor, merging | {}, {} |\n", report.extractor, report.merge_mode);
  text += fmt::format("| map hash | `{}` |\n", report.map.hash);
  text += fmt::format("| program, configuration | `{}`, `{}` |\n", report.git_revision,
                      report.config_hash);
  return text;
}

std::string plane_table(const Report& report) {
  std::string text =
      "| # | label | normal | d [m] | area [m²] | observations | rms [mm] | id |\n"
      "|--:|---|---|--:|--:|--:|--:|---|\n";
  std::size_t number = 0;
  for (const mapping::MapFeature* feature : mapping::sorted_by_id(report.map.features)) {
    const geometry::Plane& plane = feature->surface.plane;
    text += fmt::format(
        "| {} | {} | {:.3f}, {:.3f}, {:.3f} | {:.3f} | {:.3f} | {} | {:.1f} | {} |\n", ++number,
        mapping::clean_text(feature->label), plane.normal.x(), plane.normal.y(), plane.normal.z(),
        plane.d, geometry::area(feature->surface.polygon), feature->observations.size(),
        1e3 * feature->rms, to_string(feature->id));
  }
  return text;
}

std::string time_table(const Report& report) {
  std::string text =
      "| stage [ms per key frame] | mean | p50 | p95 | max |\n|---|--:|--:|--:|--:|\n";
  for (const Stage& stage : stages()) {
    const Summary s = summary_of(report, stage);
    text += fmt::format("| {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n", stage.first, 1e3 * s.mean,
                        1e3 * s.p50, 1e3 * s.p95, 1e3 * s.max);
  }
  return text;
}

std::string reduction_table(const DataReduction& r) {
  std::string text = "| data | size | of the raw data |\n|---|--:|--:|\n";
  text += fmt::format("| raw, 12 bytes a pixel of each key frame | {} | 100 % |\n",
                      size_text(r.raw_bytes));
  text += fmt::format("| point map, {} points | {} | {} |\n", r.point_map_points,
                      size_text(r.point_map_bytes), share_text(r.point_map_bytes, r.raw_bytes));
  text +=
      fmt::format("| geometric map, {} vertices (12 bytes a vertex, 16 a polygon) | {} | {} |\n",
                  r.map_vertices, size_text(r.map_bytes), share_text(r.map_bytes, r.raw_bytes));
  text += fmt::format("| its file: exact state with all events | {} | {} |\n",
                      size_text(r.map_bytes_serialised),
                      share_text(r.map_bytes_serialised, r.raw_bytes));
  return text;
}

}  // namespace

void write_report(const Report& report, const std::filesystem::path& folder) {
  mapping::write_file(
      folder / "report.json",
      to_json(report).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  mapping::write_file(
      folder / "report.md",
      fmt::format("# Geometric map of {}\n\n![The map from above, from the front and obliquely]"
                  "(map.svg)\n\n{}\n## Planes\n\nNumbers are those of the picture; world frame, "
                  "metres.\n\n{}\n## Time\n\n{}\n{:.1f} s for the whole log, reading included.\n\n"
                  "## Data reduction\n\n{}",
                  std::filesystem::path(report.log).filename().string(), overview(report),
                  plane_table(report), time_table(report), report.wall_seconds,
                  reduction_table(report.reduction)));
}

}  // namespace geomap::logs
