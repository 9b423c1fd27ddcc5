// SPDX-License-Identifier: BSD-3-Clause
// geomap-log: what is in a log, is it whole, save what is readable, cut a part out.
#include <fmt/format.h>

#include <string>

#include "logs/log_copy.hpp"
#include "logs/log_survey_text.hpp"
#include "messaging/program.hpp"

namespace {

using namespace geomap;

constexpr int kDamaged = 1;

struct Options {
  std::string command, log, out;
  logs::LogCut cut;
};

void declare_cut(messaging::OptionParser& parser, logs::LogCut& cut) {
  parser.option("--from", cut.from, "seconds after the first event, included");
  parser.option("--to", cut.to, "seconds after the first event, excluded");
  parser.option("--from-utime", cut.from_utime, "the same as the log's time in microseconds");
  parser.option("--to-utime", cut.to_utime, "the same as the log's time in microseconds");
  parser.option("--channels", cut.channels,
                "keep channels whose whole name this regular expression matches");
  parser.option("--not-channels", cut.not_channels, "leave out such channels");
}

void declare(messaging::OptionParser& parser, Options& options) {
  const auto with_log = [&](messaging::OptionParser& command) {
    command.positional("LOG", options.log, "LCM log");
  };
  const auto with_out = [&](messaging::OptionParser& command) {
    with_log(command);
    command.positional("OUT", options.out, "log to write; replaced when the new one is whole");
  };
  parser.command("info", "Channels with their types, rates, sizes and lost messages.",
                 options.command, with_log);
  parser.command("check", "Everything that is wrong with the log. Exit 0: whole, 1: damaged.",
                 options.command, with_log);
  parser.command("repair", "Copies every readable event.", options.command, with_out);
  parser.command("cut", "Copies the events of a time range and of some channels.", options.command,
                 [&](messaging::OptionParser& command) {
                   with_out(command);
                   declare_cut(command, options.cut);
                 });
}

int report_copy(const std::string& out, const logs::CopySummary& summary) {
  fmt::print("{}: {} events copied, {} left out; {} places ({} bytes) held no readable event\n",
             out, summary.events, summary.left_out, summary.damages, summary.lost_bytes);
  return 0;
}

int run(const Options& options) {
  if (options.command == "repair") {
    return report_copy(options.out, logs::repair_log(options.log, options.out));
  }
  if (options.command == "cut") {
    return report_copy(options.out, logs::cut_log(options.log, options.out, options.cut));
  }
  const logs::LogSurvey survey = logs::survey_log(options.log);
  const bool is_check = options.command == "check";
  fmt::print("{}", is_check ? logs::check_text(survey) : logs::info_text(survey));
  return is_check && !survey.is_whole() ? kDamaged : 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  return messaging::run_program(
      argc, argv,
      {.name = "geomap-log",
       .description = "Looks into LCM logs, checks and repairs them, and cuts parts out.",
       .uses_config = false},
      [&](messaging::OptionParser& parser) { declare(parser, options); },
      [&](const messaging::CommonOptions&) { return run(options); });
}
