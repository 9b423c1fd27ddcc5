// SPDX-License-Identifier: BSD-3-Clause
// geomap-mapper: the geometric map.
#include "mapping/mapper_process.hpp"

int main(int argc, char** argv) {
  using namespace geomap;
  messaging::LiveOptions options;
  return messaging::run_program(
      argc, argv,
      {.name = "geomap-mapper",
       .description = "Merges the planes of all key frames into the geometric map: PLANES in, "
                      "MAP_DELTA and MAP_SNAPSHOT out.",
       .uses_lcm = true},
      [&](messaging::OptionParser& parser) { messaging::declare_live(parser, options); },
      [&](const messaging::CommonOptions& common) {
        messaging::LiveProcess live("geomap-mapper", common, options);
        const mapping::MapperProcess mapper(mapping::read_mapper_config(common.config), live);
        return live.run([] {}, [&] { return mapper.summary(); });
      });
}
