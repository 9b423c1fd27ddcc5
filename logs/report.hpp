// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "logs/pipeline.hpp"
#include "logs/stage_times.hpp"
#include "mapping/map_snapshot.hpp"
#include "perception/sensor_messages.hpp"

namespace geomap::logs {

/// @brief Size of the data at each stage, as the paper counts it (its Table 5).
struct DataReduction {
  std::int64_t raw_bytes = 0;  // 12 bytes a pixel of each accepted key frame
  std::int64_t point_map_points = 0;
  std::int64_t point_map_bytes = 0;  // 12 bytes a point
  std::int64_t map_vertices = 0;
  std::int64_t map_bytes = 0;             // 12 bytes a vertex and 16 a polygon
  std::int64_t map_bytes_serialised = 0;  // of the exact state's file
};

/// @brief What a replay did; becomes report.json (stable keys) and report.md.
struct Report {
  std::string log;
  std::string camera;  // file whose depth correction the frames got; empty: none
  std::string extractor;
  std::string merge_mode;
  std::string git_revision;
  std::string config_hash;
  std::int64_t frames = 0;
  std::int64_t edits = 0;                        // of operators, that were done again
  std::map<std::string, std::int64_t> rejected;  // by reason
  perception::SensorMessages::Refused refused;   // by channel and reason
  std::int64_t sequence_gaps = 0;
  bool log_damaged = false;
  std::vector<KeyframeRecord> keyframes;
  perception::TrackerCounts tracking;
  bool lost_at_end = false;
  perception::PoseBufferCounts poses;  // of POSE
  std::vector<StageTimes> times;       // of all key frames of all passes
  double wall_seconds = 0.0;           // of one pass, reading included
  DataReduction reduction;
  mapping::MapSnapshot map;
};

/// @brief Writes report.json and report.md into a folder; the latter shows map.svg beside it.
/// @throws std::runtime_error when a file cannot be written.
void write_report(const Report& report, const std::filesystem::path& folder);

}  // namespace geomap::logs
