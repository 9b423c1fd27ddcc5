// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string>
#include <vector>

#include "geometry/angles.hpp"
#include "mapping/local_time.hpp"
#include "viewer/panels.hpp"

namespace geomap::viewer {
namespace {

void line(const char* name, const std::string& value) {
  ImGui::TextDisabled("%s", name);
  ImGui::SameLine(ImGui::GetFontSize() * 6.5F);
  ImGui::TextUnformatted(value.c_str());
}

void draw_feature(const App& app, const mapping::ViewFeature& feature, const Surface& surface) {
  const geometry::Plane& plane = surface.polygon.plane;
  const Eigen::Vector3d& n = plane.normal;
  const Eigen::Vector3d size = surface.box.sizes();
  line("number", fmt::format("{}{}", surface.number,
                             feature.locked ? ", held: mapping leaves it alone" : ""));
  line("id", mapping::to_string(feature.id));
  line("label", feature.label.empty() ? "-" : feature.label);
  line("normal n", fmt::format("{:.3f} {:.3f} {:.3f}", n.x(), n.y(), n.z()));
  line("offset d", fmt::format("{:.3f} m", plane.d));
  line("area", fmt::format("{:.3f} m2", surface.area));
  line("centre", fmt::format("{:.2f} {:.2f} {:.2f} m", surface.centroid.x(), surface.centroid.y(),
                             surface.centroid.z()));
  line("box", fmt::format("{:.2f} x {:.2f} x {:.2f} m", size.x(), size.y(), size.z()));
  line("seen", fmt::format("{} times", feature.observations));
  line("rms", fmt::format("{:.1f} mm", 0.1 * feature.rms));
  line("sure to",
       fmt::format("{:.2f} deg, {:.1f} mm", geometry::degrees(1e-5 * feature.sigma_angle),
                   0.1 * feature.sigma_d));
  for (const std::string& done : app.workbench.done_to(feature.id)) line("history", done);
}

// Numbers are typed, or turned up and down by the small buttons; the name has the handle's colour.
// @param is_finished becomes true when typing in it has ended.
bool motion_field(const char* name, std::size_t axis, double& value, double step,
                  const char* format, bool& is_finished) {
  ImGui::PushID(name);
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 9.5F);
  const bool is_changed = ImGui::InputDouble("##number", &value, step, 10.0 * step, format);
  is_finished = is_finished || ImGui::IsItemDeactivatedAfterEdit();
  ImGui::SameLine();
  const Rgba& color = kAxisColors[axis];
  ImGui::TextColored({color[0], color[1], color[2], 1.0F}, "%s", name);
  ImGui::PopID();
  return is_changed;
}

void draw_motion(App& app) {
  MotionNumbers numbers = app.move.numbers();
  std::array<double, 3> turn_deg{};
  for (std::size_t i = 0; i < 3; ++i) turn_deg[i] = geometry::degrees(numbers.turn[i]);
  bool is_finished = false;
  bool is_changed = motion_field("along normal", 0, numbers.shift[0], 0.01, "%.3f m", is_finished);
  is_changed |= motion_field("sideways", 1, numbers.shift[1], 0.01, "%.3f m", is_finished);
  is_changed |= motion_field("across", 2, numbers.shift[2], 0.01, "%.3f m", is_finished);
  is_changed |= motion_field("about normal", 0, turn_deg[0], 1.0, "%.2f deg", is_finished);
  is_changed |= motion_field("about sideways", 1, turn_deg[1], 1.0, "%.2f deg", is_finished);
  is_changed |= motion_field("about across", 2, turn_deg[2], 1.0, "%.2f deg", is_finished);
  if (is_changed) {
    for (std::size_t i = 0; i < 3; ++i) numbers.turn[i] = geometry::radians(turn_deg[i]);
    app.move.set(numbers);
  }
  // Enter in a field is meant for the whole motion.
  const bool is_entered =
      is_finished && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false);
  if (ImGui::Button("Move it (Enter)") || is_entered) app.move.accept();
  ImGui::SameLine();
  if (ImGui::Button("Leave it (Esc)")) app.cancel();
}

}  // namespace

void draw_selected(App& app) {
  const auto& selected = app.workbench.selected();
  if (app.tool == &app.move) draw_motion(app);
  if (selected.empty()) {
    ImGui::TextWrapped("Nothing. Click a polygon; Ctrl-click adds, Shift-drag takes all inside.");
    return;
  }
  if (selected.size() == 1) {
    const auto feature = app.workbench.scene().map.features.find(*selected.begin());
    const Surface* surface = app.workbench.surfaces().find(*selected.begin());
    if (feature != app.workbench.scene().map.features.end() && surface) {
      draw_feature(app, feature->second, *surface);
    }
    return;
  }
  double area = 0.0;
  for (const auto& id : selected) {
    if (const Surface* surface = app.workbench.surfaces().find(id)) area += surface->area;
  }
  ImGui::Text("%zu polygons, %.2f m2", selected.size(), area);
}

namespace {

enum class Wish { kNone, kUndo, kRedo, kRestore };

// One line: what it is, and at the right what can be done about it.
Wish draw_entry(const HistoryEntry& entry) {
  Wish wish = Wish::kNone;
  const bool is_done = entry.state == HistoryEntry::State::kDone;
  const bool is_undone = entry.state == HistoryEntry::State::kUndone;
  if (is_undone && ImGui::SmallButton("redo")) wish = Wish::kRedo;
  if (is_done && ImGui::SmallButton("undo")) wish = Wish::kUndo;
  if (is_undone || is_done) ImGui::SameLine();
  if (is_done && entry.keeps_out) {
    if (ImGui::SmallButton("let back")) wish = Wish::kRestore;
    if (ImGui::IsItemHovered()) {
      ImGui::SetTooltip("lets the surface come back where it is seen again");
    }
    ImGui::SameLine();
  }
  const std::string text = fmt::format("{} {}", entry.number, entry.text);
  if (is_done) {
    ImGui::TextUnformatted(text.c_str());
  } else {
    ImGui::TextDisabled("%s", text.c_str());
  }
  if (ImGui::IsItemHovered()) {
    const std::string when = mapping::local_time(entry.utime, "%F %T");
    ImGui::SetTooltip("%s\n%s, %s%s%s", text.c_str(), entry.author.c_str(), when.c_str(),
                      entry.reason.empty() ? "" : "\n", entry.reason.c_str());
  }
  return wish;
}

}  // namespace

void draw_history(App& app, float height) {
  // An undo shows in the edit that it is about.
  std::vector<const HistoryEntry*> entries;
  for (const HistoryEntry& entry : app.workbench.source().history()) {
    const bool is_shown =
        entry.kind != mapping::EditKind::kUndo && entry.kind != mapping::EditKind::kRedo;
    if (is_shown) entries.push_back(&entry);
  }
  std::reverse(entries.begin(), entries.end());
  ImGui::BeginChild("history", {0.0F, height});
  if (entries.empty()) ImGui::TextDisabled("no edits yet");
  // What is wished for is done behind the loop: it changes the history.
  Wish wish = Wish::kNone;
  std::int64_t number = 0;
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(entries.size()), ImGui::GetTextLineHeightWithSpacing());
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const HistoryEntry& entry = *entries[static_cast<std::size_t>(i)];
      ImGui::PushID(static_cast<int>(entry.number));
      const Wish wished = draw_entry(entry);
      if (wished != Wish::kNone) {
        wish = wished;
        number = entry.number;
      }
      ImGui::PopID();
    }
  }
  ImGui::EndChild();
  if (wish == Wish::kUndo) app.workbench.undo(number);
  if (wish == Wish::kRedo) app.workbench.redo(number);
  if (wish == Wish::kRestore) app.workbench.restore(number);
}

}  // namespace geomap::viewer
