// SPDX-License-Identifier: BSD-3-Clause
#include "logs/map_evaluation_run.hpp"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "drivers/truth_file.hpp"
#include "mapping/map_journal.hpp"

namespace geomap::logs {
namespace {

std::vector<mapping::MapFeature> features_of(const std::string& map) {
  return mapping::snapshot_of(mapping::load_map(map)).features;
}

std::optional<std::int64_t> read_planes_extracted(const std::filesystem::path& report) {
  constexpr const char* kKey = "planes_extracted";
  std::ifstream file(report);
  if (!file) return std::nullopt;
  const auto json = nlohmann::json::parse(file, nullptr, false);
  if (!json.is_object() || !json.contains(kKey) || !json[kKey].is_number_integer()) {
    return std::nullopt;
  }
  return json[kKey].get<std::int64_t>();
}

std::optional<std::int64_t> planes_extracted(const MapEvaluationFiles& files) {
  if (files.report.empty()) {
    return read_planes_extracted(std::filesystem::path(files.map).parent_path() / "report.json");
  }
  const auto planes = read_planes_extracted(files.report);
  if (!planes) throw std::runtime_error(files.report + " is no report with planes_extracted");
  return planes;
}

}  // namespace

std::optional<double> MapEvaluationRun::reduction_ratio() const {
  if (!planes_extracted || map_features == 0) return std::nullopt;
  return static_cast<double>(*planes_extracted) / static_cast<double>(map_features);
}

MapEvaluationRun evaluate_map_files(const MapEvaluationFiles& files) {
  const std::vector<mapping::MapFeature> features = features_of(files.map);
  MapEvaluationRun run;
  run.map = files.map;
  run.against_map = files.truth.empty();
  run.reference = run.against_map ? files.against : files.truth;
  run.map_features = features.size();
  run.planes_extracted = planes_extracted(files);
  const std::vector<ReferenceSurface> references =
      run.against_map ? reference_surfaces(features_of(files.against))
                      : reference_surfaces(drivers::read_truth(files.truth));
  run.evaluation = evaluate_map(features, references);
  return run;
}

}  // namespace geomap::logs
