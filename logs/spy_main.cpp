// SPDX-License-Identifier: BSD-3-Clause
// geomap-spy: what goes over the bus.
#include "logs/graphical_spy.hpp"
#include "logs/text_spy.hpp"
#include "messaging/program.hpp"

namespace {

using namespace geomap;

struct Options {
  bool is_text = false;
  logs::TextSpyOptions text;
};

void declare(messaging::OptionParser& parser, Options& options) {
  parser.flag("--text", options.is_text,
              "in this terminal: channels, rates, losses, latencies; so do the options below");
  parser.option("--channel", options.text.channels,
                "channels whose whole name this regular expression matches");
  parser.option("--fields", options.text.fields,
                "CHANNEL or CHANNEL.FIELD, for example RGBD_FRAME.depth_camera: what the newest "
                "message holds there; may be given more than once");
  parser.option("--once", options.text.once,
                "listens for so many seconds, prints one table and ends, with 1 when nothing was "
                "heard");
}

bool wants_text(const Options& options) {
  return options.is_text || options.text.once || !options.text.fields.empty() ||
         options.text.channels != logs::TextSpyOptions{}.channels;
}

int run(const Options& options, const messaging::CommonOptions& common) {
  if (wants_text(options)) return logs::run_text_spy(options.text, common);
  logs::run_graphical_spy(common);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  return messaging::run_program(
      argc, argv,
      {.name = "geomap-spy",
       .description =
           "Shows what goes over the bus: in windows (LCM's lcm-spy, with our message types "
           "and a viewer of frames: right click on their channel), or as text.",
       .uses_lcm = true,
       .uses_config = false},
      [&](messaging::OptionParser& parser) { declare(parser, options); },
      [&](const messaging::CommonOptions& common) { return run(options, common); });
}
