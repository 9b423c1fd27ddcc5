// SPDX-License-Identifier: BSD-3-Clause
// geomap-eval: how far a result is from a reference; or many results beside the paper's.
#include <fmt/format.h>

#include "logs/evaluation.hpp"
#include "logs/evaluation_page.hpp"
#include "messaging/program.hpp"

namespace {

int make_page(const std::string& runs, const std::string& output) {
  const auto made = geomap::logs::write_evaluation_page(runs, output);
  fmt::print(
      "{} runs, {} files missing, {} of {} bounds met\nresults in {} (open evaluation.html)\n",
      made.runs, made.missing, made.bounds - made.missed, made.bounds, output);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  namespace messaging = geomap::messaging;
  namespace logs = geomap::logs;
  logs::EvaluationOptions options;
  std::string runs;
  std::string output;
  return messaging::run_program(
      argc, argv,
      {.name = "geomap-eval",
       .description = "Compares a map with true planes or another map (--map with --truth or "
                      "--against), a trajectory with a reference (--trajectory with --reference), "
                      "or both. Or sets a folder of runs beside the paper's figures (--runs).",
       .uses_config = false},
      [&](messaging::OptionParser& parser) {
        parser.option("--map", options.map.map, "map that is evaluated (map.lcmlog)");
        parser.option("--truth", options.map.truth,
                      "true planes: what geomap-sim writes beside its log, or reference planes");
        parser.option("--against", options.map.against, "another map, taken as true");
        parser.option(
            "--report", options.map.report,
            "report.json of the map's replay, for the reduction of planes; without it the "
            "one beside the map");
        parser.option("--trajectory", options.trajectory,
                      "estimated poses, a TUM file (geomap-replay)");
        parser.option("--reference", options.reference, "true poses, a TUM file");
        parser.option("--runs", runs,
                      "folder of finished runs (scripts/evaluate): one page of all of them");
        parser.required("-o,--output", output, "folder for the results; made when missing");
        parser.option("--max-difference", options.max_difference,
                      "time between poses that are compared, at most [s]");
      },
      [&](const messaging::CommonOptions&) {
        if (!runs.empty()) {
          const logs::MapEvaluationFiles& map = options.map;
          for (const std::string& other : {map.map, map.truth, map.against, map.report,
                                           options.trajectory, options.reference}) {
            if (!other.empty()) throw messaging::ConfigError("--runs excludes all but -o");
          }
          return make_page(runs, output);
        }
        if (const std::string fault = logs::usage_fault(options); !fault.empty()) {
          throw messaging::ConfigError(fault);
        }
        const logs::Evaluation evaluation = logs::evaluate(options);
        logs::write_evaluation(evaluation, output);
        fmt::print("{}results in {} (open evaluation.md{})\n", logs::summary_text(evaluation),
                   output, evaluation.trajectory ? ", trajectory.svg" : "");
        return 0;
      });
}
