// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/sim_process.hpp"

#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <thread>

#include "drivers/fakenect_folder.hpp"
#include "drivers/truth_file.hpp"
#include "messaging/log_writer.hpp"
#include "messaging/part_file.hpp"

namespace geomap::drivers {
namespace {

using Clock = std::chrono::steady_clock;

// Of a frame that is published all the same: some views take longer than a frame's time [s].
constexpr double kMostLate = 1.0;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

VisibilityConfig visibility_config(const DepthSensorConfig& sensor) {
  VisibilityConfig config;
  config.min_range = sensor.min_range;
  config.max_range = sensor.max_range;
  return config;
}

}  // namespace

SimProcess::SimProcess(const Scene& scene, const CameraTrajectory& trajectory,
                       const SimulationConfig& config, const OdometryDriftConfig& drift)
    : caster_(scene),
      source_(scene, caster_, trajectory, config),
      drift_(drift),
      visibility_(scene, caster_, simulated_kinect(), visibility_config(config.sensor)),
      rate_(config.rate) {}

FrameMessages SimProcess::take() {
  const Eigen::Isometry3d T_odom_body = drift_.next(source_.pose().T_world_body);
  const std::optional<SourceFrame> frame = source_.next();
  if (!frame) throw std::logic_error("a simulation has ended");
  return to_messages(*frame, T_odom_body);
}

void SimProcess::skip() {
  drift_.next(source_.pose().T_world_body);
  source_.skip();
}

SimulationSummary SimProcess::record(const std::filesystem::path& log, const Proceed& proceed) {
  const Clock::time_point start = Clock::now();
  messaging::PartFile part(log.string());
  messaging::PartFile truth_part(truth_path(log).string());
  messaging::LogWriter writer(part.name());
  SimulationSummary summary;
  while (source_.position() < source_.size()) {
    if (!proceed(source_.position())) {
      summary.stopped = true;
      return summary;
    }
    const RobotPose pose = source_.pose();
    visibility_.add(pose.T_world_body * pose.T_body_camera);
    take().send([&](const char* channel, std::int64_t utime, const auto& message) {
      writer.write(channel, utime, message);
    });
    ++summary.frames;
  }
  writer.close();
  const Truth truth = visibility_.truth();
  write_truth(truth, truth_part.name());
  summary.planes = truth.planes.size();
  for (const TruthPlane& plane : truth.planes) summary.planes_seen += plane.seen ? 1 : 0;
  summary.log_bytes = std::filesystem::file_size(part.name());
  summary.simulated = static_cast<double>(summary.frames) / rate_;
  part.keep();
  truth_part.keep();
  summary.wall = seconds_since(start);
  return summary;
}

SimulationSummary SimProcess::record_kinect(const std::filesystem::path& folder,
                                            const Proceed& proceed) {
  const Clock::time_point start = Clock::now();
  FakenectFolder recording(folder);
  SimulationSummary summary;
  while (source_.position() < source_.size()) {
    if (!proceed(source_.position())) {
      summary.stopped = true;
      break;
    }
    const RobotPose pose = source_.pose();
    const Eigen::Isometry3d T_world_camera = pose.T_world_body * pose.T_body_camera;
    const std::optional<SourceFrame> frame = source_.next();
    recording.add(frame.value().frame, frame->frame.utime,
                  T_world_camera.linear().transpose() * Eigen::Vector3d::UnitZ());
    ++summary.frames;
  }
  summary.wall = seconds_since(start);
  summary.simulated = static_cast<double>(summary.frames) / rate_;
  return summary;
}

SimulationSummary SimProcess::publish(lcm::LCM& lcm, const std::string& channel_prefix,
                                      const Proceed& proceed) {
  const Clock::time_point start = Clock::now();
  SimulationSummary summary;
  while (source_.position() < source_.size()) {
    if (!proceed(source_.position())) {
      summary.stopped = true;
      break;
    }
    const double due = static_cast<double>(source_.position()) / rate_;
    const double late = seconds_since(start) - due;
    if (late > kMostLate) {
      skip();
      ++summary.dropped;
      continue;
    }
    if (late < 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(-late));
    take().send([&](const char* channel, std::int64_t, const auto& message) {
      lcm.publish(channel_prefix + channel, &message);
    });
    ++summary.frames;
  }
  summary.wall = seconds_since(start);
  summary.simulated = static_cast<double>(source_.position()) / rate_;
  return summary;
}

std::filesystem::path truth_path(const std::filesystem::path& log) {
  return std::filesystem::path(log).replace_extension(".truth.yaml");
}

std::string to_string(const SimulationSummary& summary) {
  char text[256];
  std::snprintf(text, sizeof text, "%zu frames, %.1f s", summary.frames, summary.simulated);
  std::string line = text;
  std::snprintf(text, sizeof text, ", simulated in %.1f s: %.0f frames/s", summary.wall,
                static_cast<double>(summary.frames) / summary.wall);
  line += text;
  if (summary.dropped > 0) line += "; " + std::to_string(summary.dropped) + " frames dropped";
  if (summary.planes > 0) {
    std::snprintf(text, sizeof text, "; %.1f MB; %zu of %zu planes seen",
                  1e-6 * static_cast<double>(summary.log_bytes), summary.planes_seen,
                  summary.planes);
    line += text;
  }
  return line;
}

}  // namespace geomap::drivers
