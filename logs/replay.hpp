// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "logs/report.hpp"
#include "messaging/config.hpp"

namespace geomap::logs {

/// @brief What geomap-replay is asked to do.
struct ReplayOptions {
  std::string log;
  std::filesystem::path output;  // folder; made when missing
  int threads = 1;               // key frames whose planes are extracted at the same time
  int pictures_every = 0;        // key frames between two pictures of the growing map; 0: none
  int passes = 1;                // over the whole log, for timings; all must give the same map
  std::string camera;            // camera file whose depth correction every frame gets; empty: none
  std::string log_out;           // log for derived messages (KEYFRAME, POINT_MAP, ...); empty: none
};

/// @brief Outcome of a replay.
struct ReplayResult {
  Report report;
  bool stopped = false;  // by Ctrl-C: the results are those of the part that was read
};

/// @brief The whole pipeline in this process, from a log, as fast as it goes. Writes map.lcmlog
/// (the exact state), map.svg, point_map.ply, trajectory.tum (key frames), trajectory_all.tum
/// (tracked frames), reference.tum (where the log holds TRUTH_POSE), report.json, report.md,
/// config_used.yaml, and pictures/ where asked for.
/// @throws std::runtime_error when the log cannot be read, a file cannot be written, no frame was
/// in the log, or two passes differ; messaging::ConfigError for a bad configuration.
ReplayResult replay(const ReplayOptions& options, const messaging::Config& config);

}  // namespace geomap::logs
