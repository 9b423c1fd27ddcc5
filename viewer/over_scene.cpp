// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <imgui.h>

#include <string>

#include "viewer/panels.hpp"
#include "viewer/status_text.hpp"

namespace geomap::viewer {
namespace {

using namespace std::chrono_literals;

constexpr auto kShown = 7s;  // a notice

ImU32 color32(const Rgba& rgba) {
  return ImGui::ColorConvertFloat4ToU32({rgba[0], rgba[1], rgba[2], rgba[3]});
}

// Draws in pixels of the scene's part of the window.
class ScenePen {
 public:
  ScenePen(const App& app, const Layout& layout)
      : camera_(app.view.camera()),
        origin_(layout.scene.min().x(), layout.scene.min().y()),
        scale_(layout.scale),
        shade_(color32(with_alpha(app.theme.background, 0.75F))),
        list_(ImGui::GetBackgroundDrawList()) {}

  std::optional<ImVec2> at(const Eigen::Vector3d& point) const {
    const auto pixel = camera_.project(point);
    if (!pixel) return std::nullopt;
    return at(*pixel);
  }
  ImVec2 at(const Eigen::Vector2d& pixel) const {
    return {origin_.x + static_cast<float>(pixel.x()), origin_.y + static_cast<float>(pixel.y())};
  }

  void line(const Overlay::Line& line) const {
    const auto a = at(line.a), b = at(line.b);
    if (a && b) list_->AddLine(*a, *b, color32(line.color), line.width * scale_);
  }
  void dot(const Overlay::Dot& dot) const {
    const auto center = at(dot.position);
    if (center) list_->AddCircleFilled(*center, dot.radius * scale_, color32(dot.color));
  }
  void text(const Eigen::Vector3d& position, const std::string& text, const Rgba& color) const {
    const auto center = at(position);
    if (!center) return;
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 corner(center->x - 0.5F * size.x, center->y - 0.5F * size.y);
    list_->AddRectFilled({corner.x - 2.0F, corner.y}, {corner.x + size.x + 2.0F, corner.y + size.y},
                         shade_, 2.0F);
    list_->AddText(corner, color32(color), text.c_str());
  }
  // Beside the mouse.
  void note(const std::string& text, const Rgba& color) const {
    const ImVec2 mouse = ImGui::GetMousePos();
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 corner(mouse.x + 14.0F * scale_, mouse.y + 10.0F * scale_);
    list_->AddRectFilled({corner.x - 3.0F, corner.y - 1.0F},
                         {corner.x + size.x + 3.0F, corner.y + size.y + 1.0F}, shade_, 2.0F);
    list_->AddText(corner, color32(color), text.c_str());
  }
  void rectangle(const Eigen::AlignedBox2d& box, const Rgba& color) const {
    list_->AddRectFilled(at(box.min()), at(box.max()), color32(with_alpha(color, 0.15F)));
    list_->AddRect(at(box.min()), at(box.max()), color32(color), 0.0F, 0, 1.5F * scale_);
  }
  // A line of words in a box, its upper edge at y; returns where the next one may begin.
  float banner(const std::string& text, float middle, float y, const Rgba& ink) const {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const float pad = 6.0F * scale_;
    const ImVec2 low(middle - 0.5F * size.x - pad, y);
    const ImVec2 high(middle + 0.5F * size.x + pad, y + size.y + pad);
    list_->AddRectFilled(low, high, shade_, 4.0F * scale_);
    list_->AddRect(low, high, color32(ink), 4.0F * scale_);
    list_->AddText({low.x + pad, low.y + 0.5F * pad}, color32(ink), text.c_str());
    return high.y + 4.0F * scale_;
  }

 private:
  const ViewCamera& camera_;
  ImVec2 origin_;
  float scale_;
  ImU32 shade_;
  ImDrawList* list_;
};

void draw_labels(App& app, const Layout& layout, const ScenePen& pen) {
  std::vector<SceneLabel> labels;
  const DrawContext context{app.workbench.scene(),
                            app.view.camera(),
                            app.workbench.selection(),
                            app.theme,
                            layout.scale,
                            0};
  for (const auto& renderer : app.renderers) {
    if (renderer->enabled) renderer->add_labels(context, labels);
  }
  for (const SceneLabel& label : labels) pen.text(label.position, label.text, label.color);
}

// What it is that the mouse points at.
void draw_hovered(const App& app, const ScenePen& pen) {
  const auto& hovered = app.workbench.selection().hovered;
  const auto& features = app.workbench.scene().map.features;
  const Surface* surface = hovered ? app.workbench.surfaces().find(*hovered) : nullptr;
  if (!surface || app.tool || !features.contains(*hovered)) return;
  const std::string& label = features.at(*hovered).label;
  pen.note(fmt::format("#{}{}{}, {:.2f} m2", surface->number, label.empty() ? "" : " ", label,
                       surface->area),
           app.theme.foreground);
}

void draw_banners(const App& app, const Layout& layout, const ScenePen& pen,
                  Clock::time_point now) {
  const float middle = layout.scene.center().x();
  float y = layout.scene.min().y() + 8.0F * layout.scale;
  const auto stale = stale_warning(app.workbench.scene(), app.workbench.source(), now);
  if (stale) y = pen.banner(*stale, middle, y, app.theme.bad);
  const RegistrationState& registration = app.workbench.scene().registration;
  if (registration.level == Level::kFailing) {
    y = pen.banner("Registration " + registration.text, middle, y, app.theme.bad);
  }
  if (app.tool) y = pen.banner(app.tool->hint(), middle, y, app.theme.selected);
  if (app.workbench.is_waiting()) {
    y = pen.banner("waiting for the mapper ...", middle, y, app.theme.warning);
  }
  if (app.is_filming) pen.banner("filming: F9 ends it", middle, y, app.theme.warning);
  // The answers stand at the bottom, the newest one lowest.
  const float step = ImGui::GetTextLineHeight() + 12.0F * layout.scale;
  float bottom = layout.scene.max().y() - step;
  const auto& notices = app.workbench.notices();
  for (auto notice = notices.rbegin(); notice != notices.rend(); ++notice) {
    if (now - notice->at > kShown) break;
    const Rgba& ink = notice->level == Level::kGood      ? app.theme.good
                      : notice->level == Level::kFailing ? app.theme.bad
                                                         : app.theme.warning;
    pen.banner(notice->text, middle, bottom, ink);
    bottom -= step;
  }
}

}  // namespace

void draw_over_scene(App& app, const Layout& layout, Clock::time_point now) {
  const ScenePen pen(app, layout);
  ImGui::GetBackgroundDrawList()->PushClipRect({layout.scene.min().x(), layout.scene.min().y()},
                                               {layout.scene.max().x(), layout.scene.max().y()});
  draw_labels(app, layout, pen);
  Overlay overlay;
  app.select.add_overlay(overlay);
  if (app.tool) app.tool->add_overlay(app.view.camera(), app.theme, overlay);
  for (const Overlay::Line& line : overlay.lines) pen.line(line);
  for (const Overlay::Dot& dot : overlay.dots) pen.dot(dot);
  for (const Overlay::Text& text : overlay.texts) pen.text(text.position, text.text, text.color);
  if (overlay.rectangle) pen.rectangle(*overlay.rectangle, app.theme.selected);
  draw_hovered(app, pen);
  draw_banners(app, layout, pen, now);
  ImGui::GetBackgroundDrawList()->PopClipRect();
}

}  // namespace geomap::viewer
