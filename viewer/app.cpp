// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/app.hpp"

#include <utility>

namespace geomap::viewer {

App::App(std::unique_ptr<MapSource> source, Preferences given)
    : workbench(std::move(source)),
      view(workbench),
      select(workbench),
      move(workbench),
      split(DrawKind::kSplit, workbench),
      cut(DrawKind::kCut, workbench),
      add(DrawKind::kAdd, workbench),
      measure(DrawKind::kMeasure, workbench),
      renderers(make_renderers()),
      preferences(std::move(given)),
      actions(make_actions(*this)),
      has_time_line(workbench.source().playback() != nullptr) {
  set_theme(preferences.get("theme.dark", true));
  view.load(preferences);
  for (const auto& renderer : renderers) {
    renderer->enabled = preferences.get(renderer->name() + ".enabled", renderer->enabled);
    renderer->load(preferences);
  }
}

void run(App& app, const Action& action) {
  const std::string obstacle = action.obstacle();
  if (obstacle.empty()) {
    action.run();
  } else {
    app.workbench.tell(Level::kDegraded, std::string(action.name).append(": ").append(obstacle));
  }
}

void App::start(Tool& next) {
  cancel();
  const std::string missing = next.begin();
  if (missing.empty()) {
    tool = &next;
  } else {
    workbench.tell(Level::kDegraded, missing);
  }
}

void App::update_tool() {
  if (tool && tool->is_done()) cancel();
}

void App::cancel() {
  if (!tool) return;
  tool->end();
  tool = nullptr;
}

void App::quit() {
  if (workbench.has_unsaved_edits()) {
    ask(Dialog::kQuit);
  } else {
    wants_quit = true;
  }
}

void App::save() {
  std::filesystem::path file = answer;
  if (!workbench.source().is_live() && !file.has_extension()) file += ".lcmlog";
  answer = file.string();
  const bool is_other_file = !workbench.source().is_live() &&
                             answer != workbench.source().default_save_name() &&
                             std::filesystem::exists(file);
  if (is_other_file && dialog != Dialog::kReplace) {
    ask(Dialog::kReplace, answer);
    return;
  }
  dialog = Dialog::kNone;
  workbench.save(answer);
}

void App::ask(Dialog next, const std::string& text) {
  dialog = next;
  answer = text;
}

void App::set_theme(bool is_dark) {
  theme = is_dark ? dark_theme() : light_theme();
  preferences.set("theme.dark", is_dark);
  ++settings_stamp;
}

void App::store_preferences() {
  view.store(preferences);
  for (const auto& renderer : renderers) {
    preferences.set(renderer->name() + ".enabled", renderer->enabled);
    renderer->store(preferences);
  }
}

}  // namespace geomap::viewer
