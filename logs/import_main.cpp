// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "drivers/seven_scenes_source.hpp"
#include "drivers/tum_source.hpp"
#include "logs/import.hpp"
#include "logs/import_log.hpp"
#include "messaging/camera_config.hpp"
#include "messaging/program.hpp"
#include "messaging/progress_bar.hpp"

namespace {

using namespace geomap;

struct Options {
  std::string format, input, out, channel, prior = "auto";
  std::int64_t from = 0, to = -1;
  std::vector<double> up;
  bool skip_bad = false;
  drivers::OdometryDriftConfig drift;
};

void declare(messaging::OptionParser& parser, Options& options) {
  parser.positional("INPUT", options.input, "folder of the data set, or LCM log");
  parser.positional("OUT", options.out, "log to write; replaced when the new one is whole");
  parser.required("--format", options.format, "what INPUT is: 7scenes, tum or lcm");
  parser.option(
      "--channel", options.channel,
      "of the frames in an LCM log (bot_core.images_t or kinect.frame_msg_t); empty: the one "
      "that there is");
  parser.option("--from", options.from, "first frame: file number (7scenes) or position (tum)");
  parser.option("--to", options.to, "last frame, included; -1: the last there is");
  parser.numbers("--up", options.up, 3, "direction in the data set's world that becomes +z");
  parser.choice("--prior", options.prior, {"auto", "none", "truth", "drift"},
                "what POSE says; auto: truth where there are poses");
  parser.option("--drift-m-per-m", options.drift.drift_m_per_m, "of --prior drift");
  parser.option("--drift-deg-per-m", options.drift.drift_deg_per_m, "of --prior drift");
  parser.option("--seed", options.drift.seed, "directions of --prior drift's errors");
  parser.flag(
      "--skip-bad", options.skip_bad,
      "leave out and count frames that cannot be read; without it the first one ends the import");
}

std::unique_ptr<drivers::FrameSource> open_source(const Options& options) {
  if (options.from < 0 || options.to < -1) {
    throw messaging::ConfigError("--from and --to count from 0");
  }
  if (!options.channel.empty()) throw messaging::ConfigError("--channel is for --format lcm");
  drivers::FrameRange range;
  range.from = options.from;
  if (options.to >= 0) range.to = options.to;
  if (options.format == "7scenes") {
    return std::make_unique<drivers::SevenScenesSource>(options.input, range);
  }
  if (options.format == "tum") return std::make_unique<drivers::TumSource>(options.input, range);
  throw messaging::ConfigError("--format is 7scenes, tum or lcm, not '" + options.format + "'");
}

logs::ImportSettings settings_of(const Options& options) {
  logs::ImportSettings settings;
  settings.drift = options.drift;
  settings.skip_bad = options.skip_bad;
  if (options.prior == "none") settings.prior = logs::ImportPrior::kNone;
  if (options.prior == "truth") settings.prior = logs::ImportPrior::kTruth;
  if (options.prior == "drift") settings.prior = logs::ImportPrior::kDrift;
  for (const std::string& message : options.drift.validate()) throw messaging::ConfigError(message);
  if (!options.up.empty()) {
    settings.up = Eigen::Vector3d(options.up[0], options.up[1], options.up[2]);
    if (!settings.up->allFinite() || settings.up->norm() < 1e-6) {
      throw messaging::ConfigError("--up is no direction");
    }
  }
  return settings;
}

int import_folder(const Options& options) {
  const logs::ImportSettings settings = settings_of(options);
  const std::unique_ptr<drivers::FrameSource> source = open_source(options);
  logs::ImportSummary summary;
  {
    messaging::ProgressBar progress("frames", static_cast<std::int64_t>(source->size()));
    summary = logs::import_frames(*source, settings, options.out, [&](std::size_t done) {
      progress.update(static_cast<std::int64_t>(done));
      return !messaging::stop_requested();
    });
  }
  if (summary.stopped) {
    throw std::runtime_error("stopped after " + std::to_string(summary.frames) + " of " +
                             std::to_string(source->size()) + " frames; no log was written");
  }
  std::printf("%s: %s\n", options.out.c_str(), logs::to_string(summary).c_str());
  if (!source->remark().empty()) std::printf("%s\n", source->remark().c_str());
  return 0;
}

// Depth and colour of other camera drivers as our own frames; the rest of their log stays.
int import_lcm_log(const Options& options, const messaging::Config& config) {
  if (options.from != 0 || options.to != -1 || !options.up.empty() || options.prior != "auto") {
    throw messaging::ConfigError(
        "--from, --to, --up and --prior are for folders; geomap-log cuts parts out of logs");
  }
  logs::LogImportSettings settings;
  settings.cameras = {config.read<messaging::CameraConfig>("driver_camera.depth").camera(),
                      config.read<messaging::CameraConfig>("driver_camera.color").camera()};
  settings.channel = options.channel;
  settings.skip_bad = options.skip_bad;
  const logs::LogImportSummary summary = logs::import_log(options.input, settings, options.out);
  std::printf("%s: %s\n", options.out.c_str(), logs::to_string(summary).c_str());
  return 0;
}

int run(const Options& options, const messaging::Config& config) {
  return options.format == "lcm" ? import_lcm_log(options, config) : import_folder(options);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  return messaging::run_program(
      argc, argv,
      {.name = "geomap-import",
       .description = "Turns a folder of RGB-D frames, or a log of another LCM camera driver, into "
                      "an LCM log with RGBD_FRAME."},
      [&](messaging::OptionParser& parser) { declare(parser, options); },
      [&](const messaging::CommonOptions& common) { return run(options, common.config); });
}
