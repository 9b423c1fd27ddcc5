// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "drivers/seven_scenes_source.hpp"
#include "drivers/tum_source.hpp"
#include "logs/import.hpp"
#include "messaging/program.hpp"
#include "messaging/progress_bar.hpp"

namespace {

using namespace geomap;

struct Options {
  std::string format, folder, out, prior = "auto";
  std::int64_t from = 0, to = -1;
  std::vector<double> up;
  bool skip_bad = false;
  drivers::OdometryDriftConfig drift;
};

void declare(messaging::OptionParser& parser, Options& options) {
  parser.positional("DIR", options.folder, "folder of the data set");
  parser.positional("OUT", options.out, "log to write; replaced when the new one is whole");
  parser.required("--format", options.format, "what DIR holds: 7scenes or tum");
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
  drivers::FrameRange range;
  range.from = options.from;
  if (options.to >= 0) range.to = options.to;
  if (options.format == "7scenes") {
    return std::make_unique<drivers::SevenScenesSource>(options.folder, range);
  }
  if (options.format == "tum") return std::make_unique<drivers::TumSource>(options.folder, range);
  throw messaging::ConfigError("--format is 7scenes or tum, not '" + options.format + "'");
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

int run(const Options& options) {
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

}  // namespace

int main(int argc, char** argv) {
  Options options;
  return messaging::run_program(
      argc, argv,
      {.name = "geomap-import",
       .description = "Turns a folder of RGB-D frames into an LCM log.",
       .uses_config = false},
      [&](messaging::OptionParser& parser) { declare(parser, options); },
      [&](const messaging::CommonOptions&) { return run(options); });
}
