// SPDX-License-Identifier: BSD-3-Clause
// geomap-planes: planar polygons of every key frame.
#include "perception/planes_process.hpp"

int main(int argc, char** argv) {
  using namespace geomap;
  messaging::LiveOptions options;
  return messaging::run_program(
      argc, argv,
      {.name = "geomap-planes",
       .description = "Extracts the planar polygons of every key frame: KEYFRAME in, PLANES out.",
       .uses_lcm = true},
      [&](messaging::OptionParser& parser) { messaging::declare_live(parser, options); },
      [&](const messaging::CommonOptions& common) {
        messaging::LiveProcess live("geomap-planes", common, options);
        const perception::PlanesProcess planes(perception::read_extraction_config(common.config),
                                               live);
        return live.run([] {}, [&] { return planes.summary(); });
      });
}
