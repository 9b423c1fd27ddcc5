// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <imgui.h>

#include <ctime>
#include <string>

#include "geometry/angles.hpp"
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
  line("number", fmt::format("{}{}", surface.number, feature.locked ? ", held" : ""));
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

// Numbers are typed, or turned up and down by the small buttons.
bool motion_field(const char* name, double& value, double step, const char* format) {
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 8.0F);
  return ImGui::InputDouble(name, &value, step, 10.0 * step, format);
}

void draw_motion(App& app) {
  MotionNumbers numbers = app.move.numbers();
  std::array<double, 3> turn_deg{};
  for (std::size_t i = 0; i < 3; ++i) turn_deg[i] = geometry::degrees(numbers.turn[i]);
  bool is_changed = motion_field("along normal", numbers.shift[0], 0.01, "%.3f m");
  is_changed |= motion_field("sideways", numbers.shift[1], 0.01, "%.3f m");
  is_changed |= motion_field("across", numbers.shift[2], 0.01, "%.3f m");
  is_changed |= motion_field("about normal", turn_deg[0], 1.0, "%.2f deg");
  is_changed |= motion_field("about sideways", turn_deg[1], 1.0, "%.2f deg");
  is_changed |= motion_field("about across", turn_deg[2], 1.0, "%.2f deg");
  if (is_changed) {
    for (std::size_t i = 0; i < 3; ++i) numbers.turn[i] = geometry::radians(turn_deg[i]);
    app.move.set(numbers);
  }
  if (ImGui::Button("Move it (Enter)")) app.move.accept();
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

void draw_history(App& app, float height) {
  const auto& history = app.workbench.source().history();
  ImGui::BeginChild("history", {0.0F, height});
  if (history.empty()) ImGui::TextDisabled("no edits yet");
  for (auto entry = history.rbegin(); entry != history.rend(); ++entry) {
    ImGui::PushID(static_cast<int>(entry->number));
    const bool is_done = entry->state == HistoryEntry::State::kDone;
    const bool is_about_edits = mapping::is_about_edits(entry->kind);
    const std::string text = fmt::format("{}  {}", entry->number, entry->text);
    if (is_done) {
      ImGui::TextWrapped("%s", text.c_str());
    } else {
      ImGui::TextDisabled("%s", text.c_str());
    }
    if (ImGui::IsItemHovered()) {
      const std::time_t seconds = entry->utime / 1'000'000;
      std::array<char, 32> when{};
      std::strftime(when.data(), when.size(), "%F %T", std::localtime(&seconds));
      ImGui::SetTooltip("%s, %s%s%s", entry->author.c_str(), when.data(),
                        entry->reason.empty() ? "" : "\n", entry->reason.c_str());
    }
    if (is_done && !is_about_edits) {
      if (ImGui::SmallButton("undo this")) app.workbench.undo(entry->number);
      if (entry->keeps_out) {
        ImGui::SameLine();
        if (ImGui::SmallButton("let it come back")) app.workbench.restore(entry->number);
      }
    } else if (entry->state == HistoryEntry::State::kUndone) {
      if (ImGui::SmallButton("redo this")) app.workbench.redo(entry->number);
    }
    ImGui::PopID();
  }
  ImGui::EndChild();
}

}  // namespace geomap::viewer
