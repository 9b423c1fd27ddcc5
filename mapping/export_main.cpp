// SPDX-License-Identifier: BSD-3-Clause
#include <optional>
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
  std::string view;
  std::optional<double> size;
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
        parser.choice("--view", view, {"top", "front", "oblique"},
                      "of SVG: this view alone; by default all three");
        parser.option("--size", size, "of SVG: most that its drawings are wide or high [px]");
        parser.flag("--ascii", options.ascii, "PLY as text instead of binary");
      },
      [&](const messaging::CommonOptions&) {
        check_output(out);
        if (size && !(*size >= 100.0 && *size <= 20'000.0)) {
          throw messaging::ConfigError("--size must be from 100 to 20000");
        }
        if (size) options.svg.max_width = options.svg.max_height = *size;
        if (view == "top") options.svg.views = {mapping::SvgView::kTop};
        if (view == "front") options.svg.views = {mapping::SvgView::kFront};
        if (view == "oblique") options.svg.views = {mapping::SvgView::kOblique};
        mapping::export_map(mapping::snapshot_of(mapping::load_map(map)), out, options);
        return 0;
      });
}
