// SPDX-License-Identifier: BSD-3-Clause
#include "logs/depth_calibration.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "logs/pipeline_config.hpp"
#include "messaging/convert_geometry.hpp"
#include "messaging/log_reader.hpp"
#include "messaging/program.hpp"
#include "messaging/progress_bar.hpp"
#include "perception/sensor_messages.hpp"

namespace geomap::logs {
namespace {

constexpr std::size_t kLeastKeyframes = 10;
// Of the correction, a share of the depth: more uncertain ones are refused, smaller ones are none.
constexpr double kLargestSigma = 0.012;
constexpr double kLeastCorrection = 0.002;

perception::TrackerConfig calibration_config(const messaging::Config& config) {
  perception::TrackerConfig result = perception::read_tracker_config(config);
  result.registration.method = "icp";
  result.depth_correction.enabled = true;
  result.depth_correction.sigma = 0.01;
  result.depth_correction.correlation = 20.0;
  return result;
}

void note_cameras(const perception::TrackedFrame& frame, DepthCalibration& calibration) {
  const auto& message = frame.message;
  calibration.depth = messaging::from_message(message.depth_camera);
  if (!message.color.data.empty()) {
    calibration.color = messaging::from_message(message.color_camera);
  }
}

}  // namespace

DepthCalibration calibrate_depth(const std::string& log, const messaging::Config& config) {
  const PipelineConfig settings = read_pipeline_config(config);
  DepthCalibration result;
  perception::TrackingProcess tracking(
      calibration_config(config),
      [&result](const perception::TrackedFrame& frame) { note_cameras(frame, result); });
  perception::SensorMessages input(
      tracking, {settings.driver_depth.camera(), settings.driver_color.camera()});
  messaging::LogReader reader(log);
  messaging::ProgressBar progress("frames", 0);
  while (const auto event = reader.next()) {
    input.handle(event->channel, event->data);
    progress.update(tracking.frames(), tracking.frames() * reader.size() / reader.position());
    if (messaging::stop_requested()) {
      result.stopped = true;
      return result;
    }
  }
  tracking.finish();
  result.frames = tracking.frames();
  result.keyframes = tracking.tracker().point_map().keyframes();
  if (result.frames == 0) throw std::runtime_error(log + " holds no readable RGBD_FRAME");
  if (result.keyframes < kLeastKeyframes) {
    throw std::runtime_error(fmt::format(
        "{}: {} key frames of {} frames tell too little: move the camera slowly before walls and "
        "corners",
        log, result.keyframes, result.frames));
  }
  const perception::DepthCorrectionEstimator& estimator =
      tracking.tracker().depth_correction_estimator();
  result.sigma = estimator.largest_sigma(result.depth);
  if (result.sigma > kLargestSigma) {
    throw std::runtime_error(fmt::format(
        "{}: the correction would be uncertain by {:.2f} % somewhere in the image: let every part "
        "of it see walls",
        log, 100.0 * result.sigma));
  }
  const geometry::DepthCorrection found = estimator.estimate();
  result.largest = geometry::DepthCorrection::largest_difference(found, {}, result.depth);
  if (result.largest >= kLeastCorrection) result.correction = found;
  return result;
}

}  // namespace geomap::logs
