// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <string>

#include "viewer/panels.hpp"
#include "viewer/text_field.hpp"

namespace geomap::viewer {
namespace {

constexpr const char* kTitle = "geomap";
constexpr std::array<const char*, 5> kLabels = {"wall", "floor", "ceiling", "table", "door"};

void carry_out(App& app) {
  const Dialog dialog = app.dialog;
  app.dialog = Dialog::kNone;
  if (dialog == Dialog::kConfirmDelete) app.workbench.remove();
  if (dialog == Dialog::kLabel) app.workbench.label(app.answer);
  if (dialog == Dialog::kSave) app.workbench.save(app.answer);
  if (dialog == Dialog::kExport) app.workbench.export_to(app.answer);
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
      ImGui::Text("Delete %zu polygons? Ctrl-Z brings them back.", app.workbench.selected().size());
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
  if (!ImGui::IsPopupOpen(kTitle)) ImGui::OpenPopup(kTitle);
  ImGui::SetNextWindowPos({layout.scene.center().x(), layout.scene.center().y()},
                          ImGuiCond_Appearing, {0.5F, 0.5F});
  if (!ImGui::BeginPopupModal(kTitle, nullptr, ImGuiWindowFlags_AlwaysAutoResize)) return;
  draw_question(app);
  const bool is_delete = app.dialog == Dialog::kConfirmDelete;
  if (app.dialog != Dialog::kNone) {
    const bool is_entered = is_delete && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter));
    if (ImGui::Button(is_delete ? "Delete (Enter)" : "OK (Enter)") || is_entered) carry_out(app);
    ImGui::SameLine();
    if (ImGui::Button("Cancel (Esc)") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) {
      app.dialog = Dialog::kNone;
    }
  }
  if (app.dialog == Dialog::kNone) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

void draw_help(App& app, const Layout& layout) {
  if (!app.is_help_shown) return;
  ImGui::SetNextWindowPos({layout.scene.center().x(), layout.scene.center().y()}, ImGuiCond_Always,
                          {0.5F, 0.5F});
  ImGui::Begin("Help: mouse and keys", &app.is_help_shown,
               ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoMove);
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
