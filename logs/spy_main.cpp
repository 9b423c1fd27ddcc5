// SPDX-License-Identifier: BSD-3-Clause
// geomap-spy: what goes over the bus.
#include <stdexcept>

#include "logs/text_spy.hpp"
#include "messaging/program.hpp"

namespace {

using namespace geomap;

struct Options {
  bool is_text = false;
  logs::TextSpyOptions text;
};

void declare(messaging::OptionParser& parser, Options& options) {
  parser.flag("--text", options.is_text, "in this terminal: channels, rates, losses, latencies");
  parser.option("--channel", options.text.channels,
                "of --text: channels whose whole name this regular expression matches");
  parser.option("--fields", options.text.fields,
                "of --text: CHANNEL or CHANNEL.FIELD, for example "
                "RGBD_FRAME.depth_camera: what the newest message holds there");
  parser.option("--once", options.text.once,
                "of --text: listens for so many seconds, prints one table and ends, with 1 when "
                "nothing was heard");
}

int run(const Options& options, const messaging::CommonOptions& common) {
  if (options.is_text) return logs::run_text_spy(options.text, common);
  throw std::runtime_error("only the text spy is built: geomap-spy --text");
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  return messaging::run_program(
      argc, argv,
      {.name = "geomap-spy",
       .description = "Shows what goes over the bus.",
       .uses_lcm = true,
       .uses_config = false},
      [&](messaging::OptionParser& parser) { declare(parser, options); },
      [&](const messaging::CommonOptions& common) { return run(options, common); });
}
