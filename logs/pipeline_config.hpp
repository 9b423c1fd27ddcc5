// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/geometric_map.hpp"
#include "mapping/merge_config.hpp"
#include "messaging/camera_config.hpp"
#include "messaging/config.hpp"
#include "perception/extractor_choice.hpp"
#include "perception/tracker.hpp"

namespace geomap::logs {

/// @brief The settings of every stage. One member per section of config/default.yaml.
struct PipelineConfig {
  messaging::CameraConfig driver_depth;  // section driver_camera.depth
  messaging::CameraConfig driver_color;  // section driver_camera.color
  perception::TrackerConfig tracker;  // prior, keyframes, registration, depth_correction, point_map
  perception::PlaneExtractionConfig extraction;  // sections extraction, organized, ransac
  mapping::MergeConfig merge;
  mapping::HistoryConfig history;
};

/// @brief All sections, validated. @throws messaging::ConfigError.
PipelineConfig read_pipeline_config(const messaging::Config& config);

}  // namespace geomap::logs
