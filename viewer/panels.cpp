// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/panels.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "viewer/status_text.hpp"

namespace geomap::viewer {
namespace {

constexpr float kToolbar = 40.0F, kLeft = 250.0F, kRight = 270.0F, kStatus = 48.0F,
                kTimeLine = 38.0F;   // [px at scale 1]
constexpr float kLargeImage = 4.0F;  // times the small one
constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                    ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus;

ImVec4 color(const Rgba& rgba) { return {rgba[0], rgba[1], rgba[2], rgba[3]}; }

Rgba color_of(Level level, const Theme& theme) {
  if (level == Level::kFailing) return theme.bad;
  return level == Level::kDegraded ? theme.warning : theme.good;
}

void draw_button(const Action& action, bool is_at_work) {
  const std::string obstacle = action.obstacle();
  const bool is_possible = obstacle.empty();
  if (is_at_work)
    ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
  if (!is_possible) ImGui::BeginDisabled();
  if (ImGui::Button(action.name)) action.run();
  if (!is_possible) ImGui::EndDisabled();
  if (is_at_work) ImGui::PopStyleColor();
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
    ImGui::SetTooltip("%s  (%s)%s%s", action.help, action.key_text, is_possible ? "" : "\n",
                      obstacle.c_str());
  }
}

const char* name_at_work(const App& app) {
  if (app.tool == &app.move) return "Move";
  if (app.tool == &app.split) return "Split";
  if (app.tool == &app.cut) return "Cut";
  if (app.tool == &app.add) return "Rectangle";
  return app.tool == &app.measure ? "Measure" : "";
}

// Small, and large for who points at it.
void draw_image(unsigned texture, const geometry::CameraModel& camera, float width) {
  if (texture == 0 || camera.width <= 0) return;
  const auto name = reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture));
  const float ratio = static_cast<float>(camera.height) / static_cast<float>(camera.width);
  ImGui::Image(name, {width, width * ratio});
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::Image(name, {kLargeImage * width, kLargeImage * width * ratio});
  ImGui::EndTooltip();
}

}  // namespace

Layout make_layout(const App& app, float width, float height, float scale) {
  Layout layout;
  layout.scale = scale;
  layout.size = {width, height};
  const auto box = [](float x0, float y0, float x1, float y1) {
    return Eigen::AlignedBox2f(Eigen::Vector2f(x0, y0),
                               Eigen::Vector2f(std::max(x0 + 1.0F, x1), std::max(y0 + 1.0F, y1)));
  };
  const bool has_panels = app.are_panels_shown;
  const float top = has_panels ? kToolbar * scale : 0.0F;
  const float left = has_panels ? kLeft * scale : 0.0F;
  const float right = width - (has_panels ? kRight * scale : 0.0F);
  const float status = height - (has_panels ? kStatus * scale : 0.0F);
  const bool has_time = has_panels && app.has_time_line;
  const float time_line = status - (has_time ? kTimeLine * scale : 0.0F);
  layout.toolbar = box(0.0F, 0.0F, width, top);
  layout.left = box(0.0F, top, left, status);
  layout.right = box(right, top, width, status);
  layout.scene = box(left, top, right, time_line);
  layout.time_line = box(left, time_line, right, status);
  layout.status = box(0.0F, status, width, height);
  return layout;
}

void apply_style(const Theme& theme, float scale) {
  ImGuiStyle style;
  if (theme.is_dark) {
    ImGui::StyleColorsDark(&style);
  } else {
    ImGui::StyleColorsLight(&style);
  }
  style.WindowRounding = 0.0F;
  style.FrameRounding = 3.0F;
  style.WindowBorderSize = 0.0F;
  style.FrameBorderSize = theme.is_dark ? 0.0F : 1.0F;
  style.FramePadding = {6.0F, 4.0F};
  style.ItemSpacing = {6.0F, 5.0F};
  const float shade = theme.is_dark ? 0.12F : 0.94F;
  style.Colors[ImGuiCol_WindowBg] = {shade, shade, shade + 0.01F, 1.0F};
  style.Colors[ImGuiCol_ModalWindowDimBg] = {0.0F, 0.0F, 0.0F, 0.35F};
  style.Colors[ImGuiCol_PopupBg] = {shade, shade, shade + 0.01F, 0.98F};
  style.ScaleAllSizes(scale);
  ImGui::GetStyle() = style;
}

void begin_panel(const char* name, const Eigen::AlignedBox2f& box) {
  ImGui::SetNextWindowPos({box.min().x(), box.min().y()});
  ImGui::SetNextWindowSize({box.sizes().x(), box.sizes().y()});
  ImGui::Begin(name, nullptr, kFixed);
}

void draw_toolbar(App& app, const Layout& layout) {
  begin_panel("##toolbar", layout.toolbar);
  const char* group = "";
  const std::string at_work = name_at_work(app);
  bool is_first = true;
  for (const Action& action : app.actions) {
    if (!action.is_button) continue;
    if (!is_first) ImGui::SameLine();
    if (!is_first && group != action.group) {
      ImGui::TextDisabled("|");
      ImGui::SameLine();
    }
    is_first = false;
    group = action.group;
    draw_button(action, at_work == action.name);
  }
  ImGui::End();
}

void draw_left_panel(App& app, const Layout& layout) {
  begin_panel("##left", layout.left);
  // The list has what the layers leave, but some lines at least.
  const float line = ImGui::GetFrameHeightWithSpacing();
  const float layers = line * static_cast<float>(app.renderers.size() + 4);
  if (ImGui::CollapsingHeader("Polygons", ImGuiTreeNodeFlags_DefaultOpen)) {
    draw_feature_list(app, std::max(6.0F * line, ImGui::GetContentRegionAvail().y - layers));
  }
  if (ImGui::CollapsingHeader("Layers", ImGuiTreeNodeFlags_DefaultOpen)) draw_layers(app);
  ImGui::End();
}

void draw_right_panel(App& app, const Layout& layout, unsigned color_texture,
                      unsigned depth_texture) {
  begin_panel("##right", layout.right);
  const auto& frame = app.workbench.scene().frame.newest;
  const float line = ImGui::GetFrameHeightWithSpacing();
  const float pictures = frame ? 2.0F * line + 0.4F * ImGui::GetContentRegionAvail().x : 0.0F;
  if (ImGui::CollapsingHeader("Selected", ImGuiTreeNodeFlags_DefaultOpen)) draw_selected(app);
  if (ImGui::CollapsingHeader("History", ImGuiTreeNodeFlags_DefaultOpen)) {
    draw_history(app, std::max(3.0F * line, ImGui::GetContentRegionAvail().y - pictures));
  }
  if (frame && ImGui::CollapsingHeader("Camera", ImGuiTreeNodeFlags_DefaultOpen)) {
    const float width = 0.5F * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
    draw_image(color_texture, frame->color_camera, width);
    ImGui::SameLine();
    draw_image(depth_texture, frame->depth_camera, width);
  }
  ImGui::End();
}

void draw_status(App& app, const Layout& layout, Clock::time_point now) {
  begin_panel("##status", layout.status);
  const auto items = status_items(app.workbench.scene(), app.workbench.source(), now);
  const float right = layout.status.max().x();
  bool is_first = true;
  for (const StatusItem& item : items) {
    // What has no room in this line goes to the next one.
    const float width = ImGui::CalcTextSize(item.text.c_str()).x + 40.0F * layout.scale;
    if (!is_first && ImGui::GetItemRectMax().x + width < right) {
      ImGui::SameLine(0.0F, 14.0F * layout.scale);
    }
    is_first = false;
    const Rgba ink = item.is_known ? color_of(item.level, app.theme) : app.theme.ghost;
    ImGui::TextColored(color(ink), "%s", item.level == Level::kGood ? "o" : "!");
    ImGui::SameLine(0.0F, 4.0F * layout.scale);
    ImGui::TextUnformatted(item.text.c_str());
    if (!item.detail.empty() && ImGui::IsItemHovered()) {
      ImGui::SetTooltip("%s", item.detail.c_str());
    }
  }
  ImGui::SameLine(0.0F, 14.0F * layout.scale);
  ImGui::TextDisabled("%s", app.workbench.source().title().c_str());
  ImGui::End();
}

void draw_time_line(App& app, const Layout& layout) {
  Playback* playback = app.workbench.source().playback();
  if (!playback) return;
  begin_panel("##time", layout.time_line);
  if (ImGui::Button(playback->is_playing() ? "Pause" : "Play")) {
    playback->play(!playback->is_playing());
  }
  ImGui::SameLine();
  if (ImGui::Button("Step")) playback->step();
  ImGui::SameLine();
  ImGui::SetNextItemWidth(80.0F * layout.scale);
  constexpr std::array<double, 6> kSpeeds = {0.25, 0.5, 1.0, 2.0, 4.0, 16.0};
  if (ImGui::BeginCombo("##speed", fmt::format("x {:g}", playback->speed()).c_str())) {
    for (const double speed : kSpeeds) {
      if (ImGui::Selectable(fmt::format("x {:g}", speed).c_str())) playback->set_speed(speed);
    }
    ImGui::EndCombo();
  }
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1.0F);
  auto position = static_cast<float>(playback->position());
  const std::string format = playback->progress() < 1.0
                                 ? fmt::format("reading, {:.0f} %%", 100.0 * playback->progress())
                                 : fmt::format("%.1f s of {:.1f} s", playback->duration());
  if (ImGui::SliderFloat("##position", &position, 0.0F, static_cast<float>(playback->duration()),
                         format.c_str())) {
    playback->seek(static_cast<double>(position));
  }
  ImGui::End();
}

void draw_layers(App& app) {
  for (const auto& renderer : app.renderers) {
    ImGui::PushID(renderer->name().c_str());
    if (ImGui::Checkbox("##enabled", &renderer->enabled)) ++app.settings_stamp;
    ImGui::SameLine();
    if (ImGui::TreeNodeEx(renderer->name().c_str(), ImGuiTreeNodeFlags_SpanAvailWidth)) {
      if (renderer->panel()) ++app.settings_stamp;
      ImGui::TreePop();
    }
    ImGui::PopID();
  }
}

}  // namespace geomap::viewer
