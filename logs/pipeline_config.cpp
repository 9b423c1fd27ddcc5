// SPDX-License-Identifier: BSD-3-Clause
#include "logs/pipeline_config.hpp"

#include "perception/planes_process.hpp"
#include "perception/tracking_process.hpp"

namespace geomap::logs {

PipelineConfig read_pipeline_config(const messaging::Config& config) {
  return {config.read<messaging::CameraConfig>("driver_camera.depth"),
          config.read<messaging::CameraConfig>("driver_camera.color"),
          perception::read_tracker_config(config),
          perception::read_extraction_config(config),
          config.read<mapping::MergeConfig>("merge"),
          config.read<mapping::HistoryConfig>("history")};
}

}  // namespace geomap::logs
