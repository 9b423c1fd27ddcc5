// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "logs/map_evaluation.hpp"

namespace geomap::logs {

/// @brief A map and what it is measured against; an empty name was not given.
struct MapEvaluationFiles {
  std::string map{};      // map.lcmlog
  std::string truth{};    // true planes (YAML), or
  std::string against{};  // another map
  std::string report{};   // the replay's report.json; empty: the one beside the map, if any
};

/// @brief A map compared with a reference, and where both came from.
struct MapEvaluationRun {
  std::string map;  // files, as they were named
  std::string reference;
  bool against_map = false;                      // the reference is another map
  std::size_t map_features = 0;                  // of any size
  std::optional<std::int64_t> planes_extracted;  // from which the map was made, where known
  MapEvaluation evaluation;

  /// @brief Planes extracted for each feature of the map.
  std::optional<double> reduction_ratio() const;
};

/// @brief Reads the files and compares them.
/// @throws std::runtime_error, one line with the file's name, when one cannot be used. A
/// report.json that was not named and cannot be used is passed over.
MapEvaluationRun evaluate_map_files(const MapEvaluationFiles& files);

}  // namespace geomap::logs
