// SPDX-License-Identifier: BSD-3-Clause
// geomap-sim: an RGB-D camera on a robot in a described scene, with exact truth.
#include <charconv>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "drivers/scene_file.hpp"
#include "drivers/sim_process.hpp"
#include "drivers/trajectory_file.hpp"
#include "messaging/program.hpp"
#include "messaging/progress_bar.hpp"

namespace {

using namespace geomap;

struct Options {
  std::string scene, trajectory, log, fakenect, noise = "0";
  drivers::OdometryDriftConfig drift;
  double rate = 30.0;
  double distortion = drivers::DepthSensorConfig().bias_at_corner;
};

void declare(messaging::OptionParser& parser, Options& options) {
  parser.required("--scene", options.scene, "YAML file, see config/scenes");
  parser.required("--trajectory", options.trajectory, "YAML file, see config/trajectories");
  parser.option("--log", options.log,
                "log to write, and OUT.truth.yaml beside OUT.lcmlog; empty: publish live");
  parser.option("--fakenect", options.fakenect,
                "folder to write, which fakenect plays in place of a Kinect");
  parser.option("--noise", options.noise,
                "of depth: standard deviation [m], or kinect: noise, steps, shadows, distortion");
  parser.option("--distortion", options.distortion,
                "of a Kinect's depth at the image's corner, as a share of the depth");
  parser.option("--drift-m-per-m", options.drift.drift_m_per_m, "of the odometry on POSE");
  parser.option("--drift-deg-per-m", options.drift.drift_deg_per_m, "of the odometry on POSE");
  parser.option("--seed", options.drift.seed, "of noise and drift");
  parser.option("--rate", options.rate, "frames a second");
}

drivers::SimulationConfig config_of(const Options& options) {
  drivers::SimulationConfig config;
  config.rate = options.rate;
  config.seed = options.drift.seed;
  if (options.noise == "kinect") {
    config.sensor.noise = drivers::SensorNoise::kKinect;
    config.sensor.bias_at_corner = options.distortion;
  } else {
    const char* end = options.noise.data() + options.noise.size();
    const auto parsed = std::from_chars(options.noise.data(), end, config.sensor.sigma);
    if (parsed.ec != std::errc() || parsed.ptr != end) {
      throw messaging::ConfigError("--noise is a number of metres or kinect, not '" +
                                   options.noise + "'");
    }
  }
  for (const std::string& message : config.validate()) throw messaging::ConfigError(message);
  for (const std::string& message : options.drift.validate()) throw messaging::ConfigError(message);
  return config;
}

int run(const Options& options, const messaging::CommonOptions& common) {
  if (!options.log.empty() && !options.fakenect.empty()) {
    throw messaging::ConfigError("--log and --fakenect are written one at a time");
  }
  const drivers::SimulationConfig config = config_of(options);
  const drivers::Scene scene = drivers::read_scene(options.scene);
  const drivers::CameraTrajectory trajectory(drivers::read_robot_trajectory(options.trajectory));
  drivers::SimProcess process(scene, trajectory, config, options.drift);
  drivers::SimulationSummary summary;
  {
    messaging::ProgressBar progress("frames", static_cast<std::int64_t>(process.size()));
    const auto proceed = [&](std::size_t frame) {
      progress.update(static_cast<std::int64_t>(frame));
      return !messaging::stop_requested();
    };
    if (!options.fakenect.empty()) {
      summary = process.record_kinect(options.fakenect, proceed);
    } else if (options.log.empty()) {
      lcm::LCM lcm(common.lcm_url);
      if (!lcm.good()) throw std::runtime_error("cannot open LCM at " + common.lcm_url);
      summary = process.publish(lcm, common.channel_prefix, proceed);
    } else {
      summary = process.record(options.log, proceed);
      if (summary.stopped) throw std::runtime_error("stopped; no log was written");
    }
  }
  const std::string& written = options.fakenect.empty() ? options.log : options.fakenect;
  std::printf("%s: %s\n", written.empty() ? "live" : written.c_str(),
              drivers::to_string(summary).c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  return messaging::run_program(
      argc, argv,
      {.name = "geomap-sim",
       .description = "Simulates an RGB-D camera on a robot in a scene, with exact truth.",
       .uses_lcm = true,
       .uses_config = false},
      [&](messaging::OptionParser& parser) { declare(parser, options); },
      [&](const messaging::CommonOptions& common) { return run(options, common); });
}
