// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "viewer/draw_tool.hpp"
#include "viewer/move_tool.hpp"
#include "viewer/preferences.hpp"
#include "viewer/renderer.hpp"
#include "viewer/select_tool.hpp"
#include "viewer/view_control.hpp"
#include "viewer/workbench.hpp"

namespace geomap::viewer {

/// @brief A question to the operator that waits for its answer.
enum class Dialog { kNone, kConfirmDelete, kLabel, kSave, kReplace, kExport, kOpen, kQuit };

/// @brief What the operator can have done, by key, button or menu: the help is made of this list.
struct Action {
  const char* group;
  const char* name;  // short, for a button
  const char* help;
  int key = 0;  // as GLFW numbers keys; 0: none
  bool control = false, shift = false;
  const char* key_text = "";
  bool is_button = false;
  std::function<std::string()> obstacle = {};  // why it cannot be done now; empty: it can
  std::function<void()> run = {};
};

/// @brief What all of the window works on.
class App {
 public:
  App(std::unique_ptr<MapSource> source, Preferences preferences);
  App(const App&) = delete;
  App& operator=(const App&) = delete;

  Workbench workbench;
  ViewControl view;
  SelectTool select;
  MoveTool move;
  DrawTool split, cut, add, measure;
  Tool* tool = nullptr;  // at work; null: selecting
  std::vector<std::unique_ptr<Renderer>> renderers;
  Theme theme;
  Preferences preferences;
  std::vector<Action> actions;

  bool has_time_line = false;  // the source is a log
  bool is_help_shown = false;
  bool are_panels_shown = true;
  bool wants_screenshot = false, is_filming = false, wants_fullscreen = false, wants_quit = false;
  Dialog dialog = Dialog::kNone;
  std::string answer;                // being typed
  std::filesystem::path wants_open;  // a file to look at in place of what is there
  std::string search;                // of the list
  Stamp settings_stamp = 0;          // grows when something is to be drawn otherwise

  void start(Tool& tool);
  /// @brief Goes on after a tool has done its work.
  void update_tool();
  /// @brief Ends the tool at work, if any.
  void cancel();
  /// @brief Ends the viewer, or asks first where edits would be lost.
  void quit();
  /// @brief Saves, or asks first where another file would be lost.
  void save();
  void ask(Dialog dialog, const std::string& answer = "");
  void set_theme(bool is_dark);
  void store_preferences();
};

/// @brief Does it, or tells the operator why it cannot be done.
void run(App& app, const Action& action);

/// @brief The list of all actions upon an app, which outlives it.
std::vector<Action> make_actions(App& app);

}  // namespace geomap::viewer
