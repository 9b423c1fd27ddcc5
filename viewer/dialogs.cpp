// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <string>

#include "viewer/panels.hpp"
#include "viewer/text_field.hpp"

namespace geomap::viewer {
namespace {

constexpr std::array<const char*, 5> kLabels = {"wall", "floor", "ceiling", "table", "door"};

const char* title(Dialog dialog) {
  switch (dialog) {
    case Dialog::kConfirmDelete:
      return "Delete";
    case Dialog::kLabel:
      return "Label";
    case Dialog::kSave:
      return "Save the map";
    case Dialog::kReplace:
      return "Replace the file";
    case Dialog::kExport:
      return "Export the map";
    case Dialog::kOpen:
      return "Open";
    case Dialog::kQuit:
      return "Edits are not saved";
    case Dialog::kNone:
      break;
  }
  return "";
}

void carry_out(App& app) {
  const Dialog dialog = app.dialog;
  if (dialog == Dialog::kSave || dialog == Dialog::kReplace) {
    app.save();
    return;
  }
  app.dialog = Dialog::kNone;
  if (dialog == Dialog::kConfirmDelete) app.workbench.remove();
  if (dialog == Dialog::kLabel) app.workbench.label(app.answer);
  if (dialog == Dialog::kExport) app.workbench.export_to(app.answer);
  if (dialog == Dialog::kOpen) app.wants_open = app.answer;
  if (dialog == Dialog::kQuit) app.wants_quit = true;
}

const char* verb(Dialog dialog) {
  switch (dialog) {
    case Dialog::kConfirmDelete:
      return "Delete (Enter)";
    case Dialog::kReplace:
      return "Replace";
    case Dialog::kQuit:
      return "Leave without saving";
    default:
      return "OK (Enter)";
  }
}

// Enter in the field carries it out.
void draw_text_question(App& app, const std::string& question) {
  ImGui::TextUnformatted(question.c_str());
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 26.0F);
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  if (text_field("##answer", "", app.answer)) carry_out(app);
}

void draw_label_buttons(App& app) {
  for (const char* label : kLabels) {
    if (ImGui::Button(label)) {
      app.answer = label;
      carry_out(app);
    }
    ImGui::SameLine();
  }
  ImGui::NewLine();
}

void draw_question(App& app) {
  switch (app.dialog) {
    case Dialog::kConfirmDelete:
      ImGui::Text("Delete %zu polygons%s? Ctrl-Z brings them back.",
                  app.workbench.selected().size(),
                  app.workbench.is_any_locked() ? ", held ones among them" : "");
      break;
    case Dialog::kReplace:
      ImGui::Text("%s exists: replace it?", app.answer.c_str());
      break;
    case Dialog::kOpen:
      draw_text_question(app, "A saved map or a log (file)");
      break;
    case Dialog::kQuit:
      ImGui::TextUnformatted("The map has edits that no file holds. Ctrl-S saves them.");
      break;
    case Dialog::kLabel:
      draw_label_buttons(app);
      draw_text_question(app, "or in your own words (empty: no label)");
      break;
    case Dialog::kSave:
      draw_text_question(app, "Save the map as (" + app.workbench.source().save_prompt() + ")");
      break;
    case Dialog::kExport:
      draw_text_question(app, "Export to (file: .ply, .obj, .glb, .svg or .json)");
      break;
    case Dialog::kNone:
      break;
  }
}

}  // namespace

void draw_dialogs(App& app, const Layout& layout) {
  if (app.dialog == Dialog::kNone) return;
  const Dialog dialog = app.dialog;
  if (!ImGui::IsPopupOpen(title(dialog))) ImGui::OpenPopup(title(dialog));
  ImGui::SetNextWindowPos({layout.scene.center().x(), layout.scene.center().y()},
                          ImGuiCond_Appearing, {0.5F, 0.5F});
  constexpr ImGuiWindowFlags kFlags =
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings;
  if (!ImGui::BeginPopupModal(title(dialog), nullptr, kFlags)) return;
  draw_question(app);
  const auto is_pressed = [](ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key)); };
  if (app.dialog == dialog) {
    // A question that has no field: Enter says yes, but never to losing something.
    const bool is_entered = dialog == Dialog::kConfirmDelete && is_pressed(ImGuiKey_Enter);
    if (ImGui::Button(verb(dialog)) || is_entered) carry_out(app);
    ImGui::SameLine();
    if (ImGui::Button("Cancel (Esc)") || is_pressed(ImGuiKey_Escape)) app.dialog = Dialog::kNone;
  }
  if (app.dialog != dialog) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

void draw_help(App& app, const Layout& layout) {
  if (!app.is_help_shown) return;
  ImGui::SetNextWindowPos({layout.scene.center().x(), layout.scene.center().y()}, ImGuiCond_Always,
                          {0.5F, 0.5F});
  ImGui::SetNextWindowSizeConstraints({0.0F, 0.0F}, {layout.size.x(), layout.size.y()});
  ImGui::Begin("Help: mouse and keys", &app.is_help_shown,
               ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_HorizontalScrollbar);
  constexpr std::array<std::array<const char*, 2>, 8> kMouse = {{
      {"click", "select a polygon"},
      {"Ctrl-click", "select one more, or one less"},
      {"Shift-drag", "select all that lie inside the rectangle"},
      {"double click", "fly there"},
      {"drag", "turn the view"},
      {"right or middle drag", "shift the view"},
      {"wheel", "nearer, farther"},
      {"Enter, Esc", "do it, leave it"},
  }};
  const float column = ImGui::GetFontSize() * 11.0F;
  if (ImGui::BeginTable("help", 2, ImGuiTableFlags_SizingFixedFit)) {
    ImGui::TableNextColumn();
    ImGui::TextDisabled("Mouse");
    for (const auto& [what, does] : kMouse) {
      ImGui::TextUnformatted(what);
      ImGui::SameLine(column);
      ImGui::TextUnformatted(does);
    }
    std::string group = "Mouse";
    for (const Action& action : app.actions) {
      if (*action.group == '\0') continue;
      if (group != action.group) {
        group = action.group;
        if (group == "View") ImGui::TableNextColumn();
        ImGui::TextDisabled("%s", action.group);
      }
      ImGui::TextUnformatted(action.key_text);
      ImGui::SameLine(group == "Edit" ? column : 0.55F * column);
      ImGui::Text("%s: %s", action.name, action.help);
    }
    ImGui::EndTable();
  }
  ImGui::End();
}

}  // namespace geomap::viewer
