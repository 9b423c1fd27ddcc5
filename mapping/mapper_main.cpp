// SPDX-License-Identifier: BSD-3-Clause
// geomap-mapper: the geometric map.
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "mapping/mapper_process.hpp"
#include "mapping/operator_link_process.hpp"

int main(int argc, char** argv) {
  using namespace geomap;
  messaging::LiveOptions options;
  std::string state, operator_url;
  return messaging::run_program(
      argc, argv,
      {.name = "geomap-mapper",
       .description =
           "Merges the planes of all key frames into the geometric map, and lets operators "
           "correct it: PLANES and MAP_EDIT in, MAP_DELTA, MAP_SNAPSHOT and "
           "MAP_EDIT_REPLY out.",
       .uses_lcm = true},
      [&](messaging::OptionParser& parser) {
        messaging::declare_live(parser, options);
        parser.option("--state", state,
                      "folder that keeps the map: it survives a restart or a kill");
        parser.option("--operator-url", operator_url,
                      "a second bus, which reaches the operator: the map, the camera's pose and "
                      "HEALTH go there, requests come from there; frames stay on the first");
      },
      [&](const messaging::CommonOptions& common) {
        messaging::LiveProcess live("geomap-mapper", common, options);
        auto journal = state.empty() ? nullptr : std::make_unique<mapping::EventJournal>(state);
        const mapping::MapperConfig config = mapping::read_mapper_config(common.config);
        mapping::MapperProcess mapper(config, std::move(journal), live);
        std::optional<mapping::OperatorLink> link;
        if (!operator_url.empty()) link.emplace(operator_url, config.view.kbit_per_s, live);
        return live.run([&] { mapper.finish(); }, [&] { return mapper.summary(); });
      });
}
