// SPDX-License-Identifier: BSD-3-Clause
// geomap-mapper: the geometric map.
#include <memory>
#include <string>
#include <utility>

#include "mapping/mapper_process.hpp"

int main(int argc, char** argv) {
  using namespace geomap;
  messaging::LiveOptions options;
  std::string state;
  return messaging::run_program(
      argc, argv,
      {.name = "geomap-mapper",
       .description = "Merges the planes of all key frames into the geometric map: PLANES in, "
                      "MAP_DELTA and MAP_SNAPSHOT out.",
       .uses_lcm = true},
      [&](messaging::OptionParser& parser) {
        messaging::declare_live(parser, options);
        parser.option("--state", state,
                      "folder that keeps the map: it survives a restart or a kill");
      },
      [&](const messaging::CommonOptions& common) {
        messaging::LiveProcess live("geomap-mapper", common, options);
        auto journal = state.empty() ? nullptr : std::make_unique<mapping::EventJournal>(state);
        const mapping::MapperProcess mapper(mapping::read_mapper_config(common.config),
                                            std::move(journal), live);
        return live.run([] {}, [&] { return mapper.summary(); });
      });
}
