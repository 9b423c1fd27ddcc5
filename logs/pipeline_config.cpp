// SPDX-License-Identifier: BSD-3-Clause
#include "logs/pipeline_config.hpp"

namespace geomap::logs {

PipelineConfig read_pipeline_config(const messaging::Config& config) {
  return {config.read<messaging::CameraConfig>("driver_camera.depth"),
          config.read<messaging::CameraConfig>("driver_camera.color"),
          {config.read<perception::PriorConfig>("prior"),
           config.read<perception::KeyframeConfig>("keyframes"),
           config.read<perception::RegistrationConfig>("registration"),
           config.read<perception::DepthCorrectionConfig>("depth_correction"),
           config.read<perception::PointMapConfig>("point_map")},
          {config.read<perception::ExtractorChoice>("extraction"),
           config.read<perception::OrganizedExtractorConfig>("organized"),
           config.read<perception::RansacExtractorConfig>("ransac")},
          config.read<mapping::MergeConfig>("merge"),
          config.read<mapping::HistoryConfig>("history")};
}

}  // namespace geomap::logs
