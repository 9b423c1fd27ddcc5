// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace geomap::logs {

/// @brief Errors of a map, or of the features of one true plane; nothing where not measurable.
struct AccuracyFigures {
  std::optional<double> d_coeff;
  std::optional<double> d_angle;       // [rad]
  std::optional<double> d_dist;        // [m], at the world's origin, as the paper has it
  std::optional<double> d_dist_local;  // [m], where the planes are
  std::optional<double> rms_p;         // [m]
  std::optional<double> recall;
  std::optional<double> precision;
  std::optional<double> features_per_component;
  std::optional<double> area_iou;
  std::optional<double> hull_distance_mean;  // [m]
  std::optional<double> hull_distance_max;   // [m]
  std::optional<double> reduction_ratio;     // planes extracted for each feature in the map
  std::optional<double> ate_rmse;            // of the trajectory [m]
};

/// @brief A true plane and what the map has of it.
struct PlaneResult {
  std::string name;
  bool seen = false;
  int features = 0;
  std::optional<double> components;    // separate visible parts that are large enough to count
  std::optional<double> visible_area;  // [m²]
  AccuracyFigures figures;
};

/// @brief Wall-clock time of one stage for each key frame [s].
struct StageSummary {
  double mean = 0.0;
  double p50 = 0.0;
  double p95 = 0.0;
};

/// @brief What report.json says of a replay.
struct RunReport {
  int keyframes = 0;
  int planes_extracted = 0;
  int map_features = 0;
  std::int64_t raw_bytes = 0;
  std::int64_t point_map_bytes = 0;
  std::int64_t map_bytes = 0;
  std::map<std::string, StageSummary> stages;  // decode, registration, extraction, hull, ...
  std::vector<double> extracted_growth;        // planes extracted up to each key frame
  std::vector<double> feature_growth;          // features in the map after it
};

/// @brief One replay of one log, and how its map compares with the truth.
struct Run {
  std::string set;      // "n0": which scene, way and noise
  std::string variant;  // "ransac-moments": extractor and merging
  std::string seed;     // "seed1"
  std::filesystem::path folder;
  RunReport report;
  AccuracyFigures figures;
  std::vector<PlaneResult> planes;
};

struct RunCollection {
  std::vector<Run> runs;             // by set, variant and seed
  std::vector<std::string> missing;  // files that unfinished runs lack, relative to the folder
};

/// @brief Reads the folders SET/VARIANT/SEED of a folder of runs. A run needs report.json
/// (geomap-replay) and evaluation/evaluation.json (geomap-eval); without both it is listed as
/// missing.
/// @throws std::runtime_error, one line that names the file, when a file is no JSON or lacks a key,
/// or when the folder holds no run at all.
RunCollection read_runs(const std::filesystem::path& folder);

}  // namespace geomap::logs
