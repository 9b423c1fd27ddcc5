// SPDX-License-Identifier: BSD-3-Clause
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <set>

#include "viewer/app.hpp"

namespace geomap::viewer {
namespace {

constexpr const char* kEdit = "Edit";
constexpr const char* kView = "View";
constexpr const char* kFile = "File";
constexpr const char* kTime = "Time line of a log";

std::string none() { return ""; }

// Why what is selected cannot be edited; empty when it can.
std::string obstacle(const App& app, std::size_t fewest, const char* otherwise) {
  if (app.has_time_line) return "a log cannot be edited: open a saved map";
  return app.workbench.selected().size() < fewest ? otherwise : "";
}

std::string common_label(const App& app) {
  const auto& selected = app.workbench.selected();
  if (selected.empty()) return "";
  const auto found = app.workbench.scene().map.features.find(*selected.begin());
  return found == app.workbench.scene().map.features.end() ? "" : found->second.label;
}

void select_all(App& app) {
  std::set<mapping::FeatureId> all;
  for (const auto& [id, surface] : app.workbench.surfaces().surfaces()) all.insert(id);
  app.workbench.select(std::move(all));
}

void fly_to_selected(App& app) {
  Eigen::AlignedBox3d box;
  for (const auto& id : app.workbench.selected()) {
    if (const Surface* surface = app.workbench.surfaces().find(id)) box.extend(surface->box);
  }
  app.view.fly_to(box);
}

// A mistaken key shall not empty the map: more than one, or what is held, is asked for once.
void remove(App& app) {
  if (app.workbench.selected().size() > 1 || app.workbench.is_any_locked()) {
    app.ask(Dialog::kConfirmDelete);
  } else {
    app.workbench.remove();
  }
}

void next_follow(App& app) {
  const auto next = static_cast<Follow>((static_cast<int>(app.view.follow()) + 1) % 3);
  app.view.set_follow(next);
  app.workbench.tell(Level::kGood, next == Follow::kFree ? "the view is free"
                                   : next == Follow::kPosition
                                       ? "the view follows the robot"
                                       : "the view follows and turns with the robot");
}

void add_edit_actions(App& app, std::vector<Action>& actions) {
  const auto some = [&app] { return obstacle(app, 1, "select a polygon first"); };
  const auto one = [&app] {
    const bool is_one = app.workbench.selected().size() <= 1;
    return is_one ? obstacle(app, 1, "select a polygon first") : "select one polygon alone";
  };
  const auto several = [&app] { return obstacle(app, 2, "select two polygons or more first"); };
  const auto editable = [&app] { return obstacle(app, 0, ""); };
  actions.push_back({kEdit, "Delete", "take the selected polygons out of the map, for good",
                     GLFW_KEY_DELETE, false, false, "Del", true, some, [&app] { remove(app); }});
  actions.push_back({kEdit, "Move", "move the selected polygons by handles or numbers", GLFW_KEY_M,
                     false, false, "M", true, some, [&app] { app.start(app.move); }});
  actions.push_back({kEdit, "Merge", "make one polygon of those selected", GLFW_KEY_G, false, false,
                     "G", true, several, [&app] { app.workbench.merge(); }});
  actions.push_back({kEdit, "Split", "cut the selected polygon in two along a line", GLFW_KEY_S,
                     false, false, "S", true, one, [&app] { app.start(app.split); }});
  actions.push_back({kEdit, "Cut", "cut a hole or a piece out of the selected polygon", GLFW_KEY_C,
                     false, false, "C", true, one, [&app] { app.start(app.cut); }});
  actions.push_back({kEdit, "Rectangle", "draw a new rectangle on a plane", GLFW_KEY_R, false,
                     false, "R", true, editable, [&app] { app.start(app.add); }});
  actions.push_back({kEdit, "Label", "say what the selected polygons are", GLFW_KEY_L, false, false,
                     "L", true, some, [&app] { app.ask(Dialog::kLabel, common_label(app)); }});
  actions.push_back({kEdit, "Lock", "hold the selected polygons as they are, or let go of them",
                     GLFW_KEY_K, false, false, "K", true, some,
                     [&app] { app.workbench.lock(!app.workbench.is_all_locked()); }});
  actions.push_back({kEdit, "Measure", "measure a distance between two points", GLFW_KEY_D, false,
                     false, "D", true, none, [&app] { app.start(app.measure); }});
  actions.push_back({kEdit, "Undo", "make the newest edit as if it had never been", GLFW_KEY_Z,
                     true, false, "Ctrl-Z", true, editable, [&app] { app.workbench.undo(); }});
  actions.push_back({kEdit, "Redo", "make the edit again that was undone last", GLFW_KEY_Y, true,
                     false, "Ctrl-Y", true, editable, [&app] { app.workbench.redo(); }});
  actions.push_back({"", "Redo", "", GLFW_KEY_Z, true, true, "Ctrl-Shift-Z", false, editable,
                     [&app] { app.workbench.redo(); }});
  actions.push_back({kEdit, "Select all", "select every polygon", GLFW_KEY_A, true, false, "Ctrl-A",
                     false, none, [&app] { select_all(app); }});
}

void add_view_actions(App& app, std::vector<Action>& actions) {
  const auto some = [&app] {
    return app.workbench.selected().empty() ? std::string("select a polygon first") : "";
  };
  const auto has_pose = [&app] {
    const bool is_known = app.workbench.scene().track.newest.has_value();
    return is_known ? std::string() : "the robot's camera has not told where it is";
  };
  actions.push_back({kView, "Whole map", "bring all of it into view", GLFW_KEY_HOME, false, false,
                     "Home", true, none, [&app] { app.view.show_all(); }});
  actions.push_back({kView, "From above", "look straight down, without perspective", GLFW_KEY_T,
                     false, false, "T", true, none, [&app] { app.view.look_from_above(); }});
  actions.push_back({kView, "Oblique", "look from the side and above", GLFW_KEY_P, false, false,
                     "P", true, none, [&app] { app.view.look_obliquely(); }});
  actions.push_back({kView, "Projection", "with perspective, or without", GLFW_KEY_O, false, false,
                     "O", false, none, [&app] { app.view.toggle_projection(); }});
  actions.push_back({kView, "To selected", "fly to what is selected", GLFW_KEY_F, false, false, "F",
                     false, some, [&app] { fly_to_selected(app); }});
  actions.push_back({kView, "Robot's eye", "look out of the robot's camera, or no longer",
                     GLFW_KEY_V, false, false, "V", false, has_pose,
                     [&app] { app.view.set_first_person(!app.view.is_first_person()); }});
  actions.push_back({kView, "Follow", "follow the robot: not, its place, or its place and heading",
                     GLFW_KEY_J, false, false, "J", false, has_pose, [&app] { next_follow(app); }});
  for (int number = 1; number <= 9; ++number) {
    const bool is_shown = number == 1;  // the help speaks for all nine
    actions.push_back({is_shown ? kView : "", "Bookmark", "go to the viewpoint stored as 1 to 9",
                       GLFW_KEY_0 + number, false, false, "1-9", false, none, [&app, number] {
                         if (app.view.go_to_bookmark(number)) return;
                         app.workbench.tell(
                             Level::kDegraded,
                             fmt::format("no viewpoint {0}: Ctrl-{0} stores one", number));
                       }});
    actions.push_back({is_shown ? kView : "", "Store bookmark", "store this viewpoint as 1 to 9",
                       GLFW_KEY_0 + number, true, false, "Ctrl-1-9", false, none, [&app, number] {
                         app.view.store_bookmark(number);
                         app.workbench.tell(Level::kGood,
                                            fmt::format("viewpoint {} stored", number));
                       }});
  }
  actions.push_back({kView, "Panels", "show or hide the panels", GLFW_KEY_TAB, false, false, "Tab",
                     false, none, [&app] { app.are_panels_shown = !app.are_panels_shown; }});
  actions.push_back({kView, "Light / dark", "bright or dark colours", GLFW_KEY_F10, false, false,
                     "F10", false, none, [&app] { app.set_theme(!app.theme.is_dark); }});
  actions.push_back({kView, "Full screen", "all of the screen, or a window", GLFW_KEY_F11, false,
                     false, "F11", false, none, [&app] { app.wants_fullscreen = true; }});
}

void add_file_actions(App& app, std::vector<Action>& actions) {
  actions.push_back(
      {kFile, "Save", "save the exact map", GLFW_KEY_S, true, false, "Ctrl-S", true, none,
       [&app] { app.ask(Dialog::kSave, app.workbench.source().default_save_name()); }});
  actions.push_back({kFile, "Export", "write the map for other programs (ply, obj, glb, svg, json)",
                     GLFW_KEY_E, true, false, "Ctrl-E", false, none,
                     [&app] { app.ask(Dialog::kExport, "map.glb"); }});
  actions.push_back({kFile, "Screenshot", "a picture of the window into the current folder",
                     GLFW_KEY_F12, false, false, "F12", false, none,
                     [&app] { app.wants_screenshot = true; }});
  actions.push_back({kFile, "Film", "begin or end a film of the window", GLFW_KEY_F9, false, false,
                     "F9", false, none, [&app] { app.is_filming = !app.is_filming; }});
  actions.push_back({kFile, "Open", "open a saved map or a log (or drop it on the window)",
                     GLFW_KEY_O, true, false, "Ctrl-O", false, none,
                     [&app] { app.ask(Dialog::kOpen, ""); }});
  actions.push_back({kFile, "Quit", "end the viewer", GLFW_KEY_Q, true, false, "Ctrl-Q", false,
                     none, [&app] { app.quit(); }});
  actions.push_back({kFile, "Help", "show or hide this help", GLFW_KEY_F1, false, false, "F1 or H",
                     true, none, [&app] { app.is_help_shown = !app.is_help_shown; }});
  actions.push_back({"", "Help", "", GLFW_KEY_H, false, false, "H", false, none,
                     [&app] { app.is_help_shown = !app.is_help_shown; }});
}

void add_time_actions(App& app, std::vector<Action>& actions) {
  Playback* const playback = app.workbench.source().playback();
  if (!playback) return;
  actions.push_back({kTime, "Play", "play or pause", GLFW_KEY_SPACE, false, false, "Space", false,
                     none, [playback] { playback->play(!playback->is_playing()); }});
  actions.push_back({kTime, "Step", "to the next key frame", GLFW_KEY_PERIOD, false, false, ".",
                     false, none, [playback] { playback->step(); }});
  actions.push_back({kTime, "Slower", "half as fast", GLFW_KEY_PAGE_DOWN, false, false, "PgDn",
                     false, none, [playback] { playback->set_speed(0.5 * playback->speed()); }});
  actions.push_back({kTime, "Faster", "twice as fast", GLFW_KEY_PAGE_UP, false, false, "PgUp",
                     false, none, [playback] { playback->set_speed(2.0 * playback->speed()); }});
}

}  // namespace

std::vector<Action> make_actions(App& app) {
  std::vector<Action> actions;
  add_edit_actions(app, actions);
  add_view_actions(app, actions);
  add_file_actions(app, actions);
  add_time_actions(app, actions);
  return actions;
}

}  // namespace geomap::viewer
