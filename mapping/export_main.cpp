// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>
#include <string>

#include "mapping/export.hpp"
#include "mapping/map_journal.hpp"
#include "messaging/program.hpp"

namespace {

using namespace geomap;

// A wrong extension is wrong usage, and found before a long load.
void check_output(const std::string& out) {
  try {
    mapping::check_extension(out);
  } catch (const std::invalid_argument& error) {
    throw messaging::ConfigError(error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::string map;
  std::string out;
  mapping::ExportOptions options;
  return messaging::run_program(
      argc, argv,
      {.name = "geomap-export",
       .description = "Writes a geometric map for other programs and for people.",
       .uses_config = false},
      [&](messaging::OptionParser& parser) {
        parser.positional("MAP", map, "saved map (map.lcmlog)");
        parser.positional(
            "OUT", out,
            "file to write: .ply, .obj (and .mtl), .glb, .svg or .json; replaced when "
            "the new one is whole");
        parser.flag("--ascii", options.ascii, "PLY as text instead of binary");
      },
      [&](const messaging::CommonOptions&) {
        check_output(out);
        mapping::export_map(mapping::snapshot_of(mapping::load_map(map)), out, options);
        return 0;
      });
}
