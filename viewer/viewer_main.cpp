// SPDX-License-Identifier: BSD-3-Clause
// geomap-viewer: the operator's window, live or of a file.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "messaging/log.hpp"
#include "messaging/program.hpp"
#include "viewer/live_source_client.hpp"
#include "viewer/log_source_client.hpp"
#include "viewer/map_file_client.hpp"
#include "viewer/offscreen_viewer.hpp"
#include "viewer/open_file_client.hpp"
#include "viewer/png_file.hpp"
#include "viewer/preferences.hpp"
#include "viewer/view_control.hpp"
#include "viewer/window.hpp"

namespace {

using namespace geomap;

constexpr double kEndOfTime = 1e9;  // later than that of any log [s]
constexpr double kSettle = 1.0;     // without anything new, before a picture is taken [s]
constexpr int kFrames = 2;          // until Dear ImGui has settled

struct Arguments {
  std::string file, map, log, screenshot, view, preferences, theme;
  std::vector<double> size = {1280, 800};
  std::optional<double> at;
  double scale = 0.0, patience = 10.0;
  bool has_panels = false;
};

std::unique_ptr<viewer::MapSource> open_source(const Arguments& arguments,
                                               const messaging::CommonOptions& common) {
  const int files = !arguments.file.empty() + !arguments.map.empty() + !arguments.log.empty();
  if (files > 1) throw messaging::ConfigError("give one map or one log");
  if (!arguments.file.empty()) return viewer::open_file(arguments.file);
  if (!arguments.map.empty()) return viewer::open_map_file(arguments.map);
  if (!arguments.log.empty()) return viewer::open_log(arguments.log);
  return viewer::open_live({.url = common.lcm_url, .channel_prefix = common.channel_prefix});
}

viewer::Preferences load_preferences(const std::filesystem::path& file, const std::string& theme) {
  viewer::Preferences preferences;
  try {
    preferences = viewer::Preferences::load(file);
  } catch (const std::exception& error) {
    messaging::log_error(error.what());  // what cannot be read shall not keep the viewer away
  }
  if (!theme.empty()) preferences.set("theme.dark", theme == "dark");
  return preferences;
}

void prepare(viewer::App& app, const std::string& view) {
  if (view == "top") app.view.look_from_above();
  if (view == "oblique") app.view.look_obliquely();
  if (view == "robot") app.view.set_first_person(true);
  if (view.size() == 1) {
    app.view.load(app.preferences);
    app.view.go_to_bookmark(view.front() - '0');
  }
  app.view.land();
}

// A picture of a log is of its end, or of a time in it.
void seek(viewer::MapSource& source, std::optional<double> at) {
  if (viewer::Playback* playback = source.playback()) {
    playback->play(false);
    playback->seek(at.value_or(kEndOfTime));
  }
}

int make_picture(const Arguments& arguments, std::unique_ptr<viewer::MapSource> source,
                 const viewer::Preferences& preferences) {
  seek(*source, arguments.at);
  const double settle = source->is_live() ? kSettle : 0.0;
  viewer::OffscreenViewer offscreen(
      std::move(source), preferences, static_cast<int>(arguments.size[0]),
      static_cast<int>(arguments.size[1]), arguments.scale > 0.0 ? arguments.scale : 1.0);
  offscreen.app().are_panels_shown = arguments.has_panels;
  offscreen.wait_for_scene(settle, arguments.patience);
  offscreen.draw();
  prepare(offscreen.app(), arguments.view);  // the size of the drawing is known by now
  for (int frame = 0; frame < kFrames; ++frame) offscreen.draw();
  viewer::write_png(arguments.screenshot, offscreen.image());
  fmt::print("{}\n", arguments.screenshot);
  return 0;
}

int run(const Arguments& arguments, const messaging::CommonOptions& common) {
  for (const double side : arguments.size) {
    if (!(side >= 64.0 && side <= 16'384.0)) {
      throw messaging::ConfigError("--size must be from 64 to 16384 pixels each way");
    }
  }
  if (arguments.scale < 0.0 || arguments.scale > 8.0) {
    throw messaging::ConfigError("--scale must be from 0 to 8");
  }
  auto source = open_source(arguments, common);
  const std::filesystem::path file = arguments.preferences.empty()
                                         ? viewer::Preferences::default_file()
                                         : std::filesystem::path(arguments.preferences);
  const viewer::Preferences preferences = load_preferences(file, arguments.theme);
  if (!arguments.screenshot.empty()) {
    return make_picture(arguments, std::move(source), preferences);
  }
  viewer::WindowOptions options;
  options.width = static_cast<int>(arguments.size[0]);
  options.height = static_cast<int>(arguments.size[1]);
  options.scale = arguments.scale;
  options.is_to_end = messaging::stop_requested;
  options.open = viewer::open_file;
  viewer::run_window(std::move(source), preferences, options).save(file);
  return 0;
}

void declare(messaging::OptionParser& parser, Arguments& arguments) {
  parser.optional_positional("FILE", arguments.file, "a saved map or a log; none: what runs now");
  parser.option("--map", arguments.map, "a saved map (map.lcmlog)");
  parser.option("--log", arguments.log, "a log, with a time line");
  parser.option("--screenshot", arguments.screenshot,
                "no window: write a picture (.png) and end; needs no display");
  parser.choice("--view", arguments.view,
                {"", "oblique", "top", "robot", "1", "2", "3", "4", "5", "6", "7", "8", "9"},
                "of the picture: a stored viewpoint by its number, or one of these");
  parser.flag("--panels", arguments.has_panels, "show the panels in the picture");
  parser.option("--at", arguments.at, "of a log: time of the picture from its beginning [s]");
  parser.option("--patience", arguments.patience, "of a picture: to wait for anything to show [s]");
  parser.numbers("--size", arguments.size, 2, "of window or picture [px]");
  parser.option("--scale", arguments.scale, "of text and lines; 0: as the display says");
  parser.choice("--theme", arguments.theme, {"", "dark", "light"}, "colours; else as last time");
  parser.option("--preferences", arguments.preferences,
                "file that keeps what is set; by default in the user's configuration folder");
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  return messaging::run_program(
      argc, argv,
      {.name = "geomap-viewer",
       .description = "The operator's window: shows map, robot and camera, and corrects the map; "
                      "of a running system, a saved map or a log. F1 in it shows all keys.",
       .uses_lcm = true,
       .uses_config = false},
      [&](messaging::OptionParser& parser) { declare(parser, arguments); },
      [&](const messaging::CommonOptions& common) { return run(arguments, common); });
}
