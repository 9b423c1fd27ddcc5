// SPDX-License-Identifier: BSD-3-Clause
#include "logs/evaluation_runs.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

namespace geomap::testing {
namespace {

using nlohmann::json;

json plane(const std::string& name, double error) {
  return {{"name", name},           {"seen", true},    {"features", 1},
          {"components", 1},        {"area", 4.0},     {"visible_area", 3.5},
          {"d_angle", error},       {"d_dist", error}, {"d_coeff", error},
          {"rms_p", 2 * error},     {"map_area", 3.4}, {"area_iou", 0.95},
          {"d_dist_local", nullptr}};
}

// Without a feature in the map.
json hidden(const std::string& name, bool seen, const json& components) {
  return {{"name", name},
          {"seen", seen},
          {"features", 0},
          {"components", components},
          {"visible_area", nullptr},
          {"d_angle", nullptr},
          {"hull_distance", nullptr}};
}

json stage(double mean) { return {{"mean", mean}, {"p50", mean}, {"p95", 2 * mean}, {"max", 1.0}}; }

json evaluation_of_run(double error) {
  return {{"d_coeff", 2 * error},
          {"d_angle", error},
          {"d_dist", 3 * error},
          {"d_dist_local", 2 * error},
          {"rms_p", 2 * error},
          {"recall", 1.0},
          {"precision", 1.0},
          {"features_per_component", 1.0},
          {"area_iou", 0.95},
          {"hull_distance", {{"mean", 0.01}, {"max", 0.05}}},
          {"reduction_ratio", 4.0},
          {"ate", {{"rmse", 0.012}}},
          {"planes",
           {plane("floor", error), plane("door <left>", error), hidden("ceiling", false, 0),
            hidden("crumb", true, 0), hidden("unfound", true, nullptr)}}};
}

json report_of_run() {
  return {{"keyframes", 4},
          {"planes_extracted", 20},
          {"map_features", 5},
          {"bytes", {{"raw", 1'000'000}, {"point_map", 10'000}, {"map", 50}}},
          {"growth", {{"planes_extracted", {5, 10, 15, 20}}, {"map_features", {5, 6, 5, 5}}}},
          {"stage_seconds",
           {{"decode", stage(0.001)},
            {"registration", stage(0.010)},
            {"extraction", stage(0.020)},
            {"hull", stage(0.015)},
            {"merging", stage(0.004)},
            {"total", stage(0.050)}}}};
}

// Writes an object, changed.
void write_json(const std::filesystem::path& file, json object, const std::string& changes) {
  object.merge_patch(json::parse(changes));
  std::ofstream(file) << object;
}

}  // namespace

void write_run(const std::filesystem::path& run, double error, const RunChanges& changes) {
  std::filesystem::create_directories(run / "evaluation");
  write_json(run / "evaluation/evaluation.json", evaluation_of_run(error), changes.evaluation);
  write_json(run / "report.json", report_of_run(), changes.report);
  std::ofstream(run / "map.svg") << "<?xml version=\"1.0\"?>\n<svg xmlns=\"http://www.w3.org/2000/"
                                    "svg\"><g id=\"walls\"><rect/></g></svg>\n";
}

std::string line_after(const std::string& text, const std::string& after,
                       const std::string& begin) {
  const std::size_t from = text.find(after);
  const std::size_t at = from == std::string::npos ? from : text.find("\n" + begin, from);
  if (at == std::string::npos) return "no line " + begin + " after " + after;
  return text.substr(at + 1, text.find('\n', at + 1) - at - 1);
}

void RunsFolder::write_paper_sets() const {
  for (const char* set : {"n0", "n005", "n02", "n0obj", "kinect"}) {
    for (const char* seed : {"seed1", "seed2"}) {
      const double error = std::string(seed) == "seed1" ? 0.0008 : 0.0010;
      write_run(run(std::string(set) + "/ransac-moments/" + seed), error);
      write_run(run(std::string(set) + "/ransac-paper/" + seed), 0.008);
    }
  }
}

}  // namespace geomap::testing
