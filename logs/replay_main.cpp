// SPDX-License-Identifier: BSD-3-Clause
// geomap-replay: the whole pipeline from a recorded log, in one process.
#include <fmt/format.h>

#include <cstdio>
#include <vector>

#include "logs/replay.hpp"
#include "messaging/program.hpp"

namespace {

void print_summary(const geomap::logs::ReplayResult& result, const std::filesystem::path& output) {
  const geomap::logs::Report& report = result.report;
  fmt::print(
      "{}{} frames, {} key frames, {} features in {:.1f} s\nmap_hash {}\nresults in {} (open "
      "report.md, map.svg)\n",
      result.stopped ? "stopped early: " : "", report.frames, report.keyframes.size(),
      report.map.features.size(), report.wall_seconds, report.map.hash, output.string());
}

}  // namespace

int main(int argc, char** argv) {
  namespace messaging = geomap::messaging;
  geomap::logs::ReplayOptions options;
  std::string output;
  std::string merge;
  std::string extractor;
  return messaging::run_program(
      argc, argv,
      {.name = "geomap-replay",
       .description = "Turns a log of depth frames into a point map and a map of planar polygons."},
      [&](messaging::OptionParser& parser) {
        parser.positional("LOG", options.log, "LCM log with RGBD_FRAME and POSE (geomap-import)");
        parser.required("-o,--output", output, "folder for the results; made when missing");
        parser.choice("--extractor", extractor, {"organized", "ransac"},
                      "how planes are found (extraction.extractor)");
        parser.choice("--merge", merge, {"moments", "paper"}, "how planes are merged (merge.mode)");
        parser.option("--camera", options.camera,
                      "camera file whose depth correction every frame gets (not for a log of "
                      "geomap-kinect --camera, which is corrected)");
        parser.option("--threads", options.threads, "key frames extracted at the same time");
        parser.option("--log-out", options.log_out, "write derived messages into this log");
        parser.option("--pictures-every", options.pictures_every,
                      "key frames between two pictures of the growing map; 0: none");
        parser.option("--loop", options.passes, "passes over the log, for timings");
      },
      [&](const messaging::CommonOptions& common) {
        options.output = output;
        std::vector<std::string> overrides;
        if (!extractor.empty()) overrides.push_back("extraction.extractor=" + extractor);
        if (!merge.empty()) overrides.push_back("merge.mode=" + merge);
        const messaging::Config config = common.config.with(overrides);
        const geomap::logs::ReplayResult result = geomap::logs::replay(options, config);
        print_summary(result, options.output);
        return result.stopped ? 1 : 0;
      });
}
