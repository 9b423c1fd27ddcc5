// SPDX-License-Identifier: BSD-3-Clause
// geomap-eval: how far a result is from a reference.
#include <fmt/format.h>

#include "logs/evaluation.hpp"
#include "messaging/program.hpp"

int main(int argc, char** argv) {
  namespace messaging = geomap::messaging;
  namespace logs = geomap::logs;
  logs::EvaluationOptions options;
  std::string output;
  return messaging::run_program(
      argc, argv,
      {.name = "geomap-eval",
       .description = "Compares a map with true planes or another map (--map with --truth or "
                      "--against), a trajectory with a reference (--trajectory with --reference), "
                      "or both.",
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
        parser.required("-o,--output", output, "folder for the results; made when missing");
        parser.option("--max-difference", options.max_difference,
                      "time between poses that are compared, at most [s]");
      },
      [&](const messaging::CommonOptions&) {
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
