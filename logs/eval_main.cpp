// SPDX-License-Identifier: BSD-3-Clause
// geomap-eval: how far a result is from a reference.
#include <fmt/format.h>

#include <cstdio>

#include "logs/evaluation.hpp"
#include "messaging/program.hpp"

int main(int argc, char** argv) {
  namespace messaging = geomap::messaging;
  namespace logs = geomap::logs;
  std::string trajectory;
  std::string reference;
  std::string output;
  double max_difference = 0.02;
  return messaging::run_program(
      argc, argv,
      {.name = "geomap-eval",
       .description = "Compares a trajectory with a reference: absolute and relative errors.",
       .uses_config = false},
      [&](messaging::OptionParser& parser) {
        parser.required("--trajectory", trajectory, "estimated poses, a TUM file (geomap-replay)");
        parser.required("--reference", reference, "true poses, a TUM file");
        parser.required("-o,--output", output, "folder for the results; made when missing");
        parser.option("--max-difference", max_difference,
                      "time between poses that are compared, at most [s]");
      },
      [&](const messaging::CommonOptions&) {
        const logs::TrajectoryEvaluation evaluation =
            logs::evaluate_trajectory(trajectory, reference, max_difference);
        logs::write_evaluation(evaluation, output);
        fmt::print("{}results in {} (open evaluation.md, trajectory.svg)\n",
                   logs::summary_text(evaluation), output);
        return 0;
      });
}
