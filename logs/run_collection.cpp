// SPDX-License-Identifier: BSD-3-Clause
#include "logs/run_collection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

namespace geomap::logs {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kReport = "report.json";
constexpr const char* kEvaluation = "evaluation/evaluation.json";

// "seed10" after "seed9".
bool by_length_then_name(const fs::path& a, const fs::path& b) {
  const std::string first = a.filename().string();
  const std::string second = b.filename().string();
  return std::pair(first.size(), first) < std::pair(second.size(), second);
}

std::vector<fs::path> folders_in(const fs::path& folder) {
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const bool hidden = entry.path().filename().string().starts_with(".");
    if (entry.is_directory() && !hidden) folders.push_back(entry.path());
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

std::optional<double> number(const json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || found->is_null()) return std::nullopt;
  return found->get<double>();
}

// A key of an object within, where there is one.
std::optional<double> number(const json& object, const char* outer, const char* key) {
  const auto found = object.find(outer);
  if (found == object.end() || found->is_null()) return std::nullopt;
  return number(*found, key);
}

AccuracyFigures figures_from(const json& object) {
  AccuracyFigures figures;
  figures.d_coeff = number(object, "d_coeff");
  figures.d_angle = number(object, "d_angle");
  figures.d_dist = number(object, "d_dist");
  figures.d_dist_local = number(object, "d_dist_local");
  figures.rms_p = number(object, "rms_p");
  figures.recall = number(object, "recall");
  figures.precision = number(object, "precision");
  figures.features_per_component = number(object, "features_per_component");
  figures.area_iou = number(object, "area_iou");
  figures.hull_distance_mean = number(object, "hull_distance", "mean");
  figures.hull_distance_max = number(object, "hull_distance", "max");
  figures.reduction_ratio = number(object, "reduction_ratio");
  figures.ate_rmse = number(object, "ate", "rmse");
  return figures;
}

PlaneResult plane_from(const json& object) {
  PlaneResult plane;
  plane.name = object.at("name").get<std::string>();
  plane.seen = object.at("seen").get<bool>();
  plane.features = object.at("features").get<int>();
  plane.components = number(object, "components");
  plane.visible_area = number(object, "visible_area");
  plane.figures = figures_from(object);
  return plane;
}

RunReport report_from(const json& object) {
  RunReport report;
  report.keyframes = object.at("keyframes").get<int>();
  report.planes_extracted = object.at("planes_extracted").get<int>();
  report.map_features = object.at("map_features").get<int>();
  const json& bytes = object.at("bytes");
  report.raw_bytes = bytes.at("raw").get<std::int64_t>();
  report.point_map_bytes = bytes.at("point_map").get<std::int64_t>();
  report.map_bytes = bytes.at("map").get<std::int64_t>();
  for (const auto& [stage, times] : object.at("stage_seconds").items()) {
    report.stages[stage] = {times.at("mean").get<double>(), times.at("p50").get<double>(),
                            times.at("p95").get<double>()};
  }
  const json& growth = object.at("growth");
  report.extracted_growth = growth.at("planes_extracted").get<std::vector<double>>();
  report.feature_growth = growth.at("map_features").get<std::vector<double>>();
  if (report.extracted_growth.size() != report.feature_growth.size()) {
    throw std::runtime_error("the series of growth differ in length");
  }
  return report;
}

// Hands the file's content to `use`; what fails says which file it was.
template <typename Use>
void with_json(const fs::path& file, const Use& use) {
  try {
    std::ifstream stream(file);
    use(json::parse(stream));
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

Run read_run(const fs::path& folder) {
  Run run;
  run.seed = folder.filename().string();
  run.variant = folder.parent_path().filename().string();
  run.set = folder.parent_path().parent_path().filename().string();
  run.folder = folder;
  with_json(folder / kReport, [&](const json& content) { run.report = report_from(content); });
  with_json(folder / kEvaluation, [&](const json& content) {
    run.figures = figures_from(content);
    const auto planes = content.find("planes");
    if (planes == content.end() || planes->is_null()) return;
    for (const json& plane : *planes) run.planes.push_back(plane_from(plane));
  });
  return run;
}

}  // namespace

RunCollection read_runs(const fs::path& folder) {
  if (!fs::is_directory(folder)) {
    throw std::runtime_error(fmt::format("{}: no such folder", folder.string()));
  }
  RunCollection collection;
  const auto add = [&](const fs::path& run) {
    bool complete = true;
    for (const char* file : {kReport, kEvaluation}) {
      if (fs::exists(run / file)) continue;
      complete = false;
      collection.missing.push_back(fs::relative(run / file, folder).generic_string());
    }
    if (complete) collection.runs.push_back(read_run(run));
  };
  for (const fs::path& set : folders_in(folder)) {
    for (const fs::path& variant : folders_in(set)) {
      std::vector<fs::path> seeds = folders_in(variant);
      std::sort(seeds.begin(), seeds.end(), by_length_then_name);
      for (const fs::path& seed : seeds) add(seed);
    }
  }
  if (collection.runs.empty()) {
    throw std::runtime_error(fmt::format("{}: no finished run SET/VARIANT/SEED with {} and {}",
                                         folder.string(), kReport, kEvaluation));
  }
  return collection;
}

}  // namespace geomap::logs
