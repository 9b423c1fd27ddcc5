// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/viewer_core.hpp"

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>
#include <imgui.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "viewer/framebuffer.hpp"
#include "viewer/image_texture.hpp"
#include "viewer/renderers.hpp"

namespace geomap::viewer {
namespace {

using namespace std::chrono_literals;

constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr float kFontSize = 13.0F;              // [px at scale 1]
constexpr auto kStatusPeriod = 1s;              // ages are counted on
constexpr double kSlow = 0.040, kFast = 0.012;  // of one drawing: fewer points, more points [s]
constexpr std::size_t kMostTold = 100;
constexpr double kRoom = 0.15;  // for a map that grows, as a share of its size
constexpr std::size_t kFewestPoints = 20'000, kMostPoints = 5'000'000, kFirstPoints = 150'000;

double seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

std::vector<EventHandler*> handlers_of(App& app, Tool* tool) {
  if (!tool) return {&app.select, &app.view};
  return {tool, &app.select, &app.view};
}

}  // namespace

ViewerCore::ViewerCore(std::unique_ptr<MapSource> source, Preferences preferences, float scale)
    : scale_(scale),
      app_(std::make_unique<App>(std::move(source), std::move(preferences))),
      framebuffer_(std::make_unique<Framebuffer>(1, 1)),
      color_(std::make_unique<ImageTexture>()),
      depth_(std::make_unique<ImageTexture>()),
      point_budget_(kFirstPoints) {
  set_fonts();
}

ViewerCore::~ViewerCore() = default;

void ViewerCore::set_fonts() {
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  if (!io.Fonts->Fonts.empty()) return;  // another source in the same window
  // Dear ImGui's own font knows ASCII alone and one size.
  if (std::filesystem::exists(kFont)) {
    io.Fonts->AddFontFromFileTTF(kFont, kFontSize * scale_);
  } else {
    io.Fonts->AddFontDefault();
    io.FontGlobalScale = scale_;
  }
}

bool ViewerCore::update(Clock::time_point now) {
  bool is_changed = app_->workbench.update(now);
  is_changed |= app_->view.update(now);
  return is_changed || now - status_drawn_ >= kStatusPeriod;
}

bool ViewerCore::is_moving() const { return app_->view.is_flying() || point_budget_ == 0; }

void ViewerCore::draw(unsigned framebuffer, int width, int height, Clock::time_point now) {
  status_drawn_ = now;
  if (styled_dark_ != app_->theme.is_dark) {
    apply_style(app_->theme, scale_);
    styled_dark_ = app_->theme.is_dark;
  }
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const Layout layout = make_layout(*app_, size.x, size.y, scale_);
  const Eigen::Vector2f scene_size = layout.scene.sizes();
  app_->view.camera().resize(static_cast<int>(scene_size.x()), static_cast<int>(scene_size.y()));
  show_all_while_untouched();
  take_keys();
  take_mouse(layout);
  app_->update_tool();
  if (app_->are_panels_shown) {
    upload_images();
    draw_toolbar(*app_, layout);
    draw_left_panel(*app_, layout);
    draw_right_panel(*app_, layout, color_->name(), depth_->name());
    draw_status(*app_, layout, now);
    draw_time_line(*app_, layout);
  }
  draw_dialogs(*app_, layout);
  draw_help(*app_, layout);
  app_->update_tool();
  draw_scene(layout);
  ImGui::GetBackgroundDrawList()->AddImage(
      reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(framebuffer_->texture())),
      {layout.scene.min().x(), layout.scene.min().y()},
      {layout.scene.max().x(), layout.scene.max().y()}, {0.0F, 1.0F}, {1.0F, 0.0F});
  draw_over_scene(*app_, layout, now);
  ImGui::Render();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, width, height);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

ViewerCore::SceneKey ViewerCore::scene_key() const {
  const SceneModel& scene = app_->workbench.scene();
  return {{scene.map.stamp, scene.points.stamp, scene.frame.stamp, scene.planes.stamp,
           scene.track.stamp, app_->settings_stamp},
          app_->view.camera().view_projection(),
          {app_->view.camera().width(), app_->view.camera().height()},
          app_->workbench.selection()};
}

// The scene is drawn only when it has changed: a word in a panel costs no points.
void ViewerCore::draw_scene(const Layout& layout) {
  const SceneKey key = scene_key();
  if (key == drawn_) return;
  drawn_ = key;
  const Clock::time_point begin = Clock::now();
  const ViewCamera& camera = app_->view.camera();
  framebuffer_->resize(camera.width(), camera.height());
  framebuffer_->begin(app_->theme.background);
  const DrawContext context{app_->workbench.scene(),
                            camera,
                            app_->workbench.selection(),
                            app_->theme,
                            layout.scale,
                            point_budget_};
  for (const std::string& fault : draw_all(app_->renderers, context)) {
    if (told_.insert(fault).second) app_->workbench.tell(Level::kFailing, fault);
  }
  glFinish();  // to know what it took
  if (told_.size() > kMostTold) told_.clear();
  const double took = seconds(Clock::now() - begin);
  if (took > kSlow) point_budget_ = std::max(kFewestPoints, point_budget_ * 3 / 4);
  if (took < kFast) point_budget_ = std::min(kMostPoints, point_budget_ * 5 / 4);
}

// A map that grows stays in view as a whole, until the operator looks where he wants.
void ViewerCore::show_all_while_untouched() {
  if (!app_->view.is_untouched()) return;
  const Eigen::AlignedBox3d& bounds = app_->workbench.bounds();
  if (bounds.isEmpty() || shown_.contains(bounds)) return;
  const bool is_first = shown_.isEmpty();
  shown_ = bounds;
  if (!is_first) {
    const Eigen::Vector3d room = kRoom * bounds.sizes();
    shown_.extend(bounds.min() - room);
    shown_.extend(bounds.max() + room);
  }
  app_->view.show_at_once(shown_);
}

void ViewerCore::upload_images() {
  const FrameLayer& layer = app_->workbench.scene().frame;
  if (!layer.newest || layer.stamp == image_stamp_) return;
  image_stamp_ = layer.stamp;
  const geometry::ColorImage& color = layer.newest->color;
  if (!color.empty()) color_->set({color.width, color.height, color.rgb});
  depth_->set(depth_picture(layer.newest->depth));
}

// Whoever is typing, or answers a question, means no action.
void ViewerCore::take_keys() {
  const bool is_typing = ImGui::GetIO().WantTextInput;
  for (const KeyPress& key : std::exchange(keys_, {})) {
    if (is_typing || app_->dialog != Dialog::kNone) continue;
    if (take_tool_key(key.key)) continue;
    for (const Action& action : app_->actions) {
      const bool is_meant = action.key != 0 && key.key == action.key &&
                            key.control == action.control && key.shift == action.shift;
      if (is_meant) run(*app_, action);
    }
  }
}

bool ViewerCore::take_tool_key(int key) {
  Tool* const tool = app_->tool;
  switch (key) {
    case GLFW_KEY_ESCAPE:
      if (app_->is_help_shown) {
        app_->is_help_shown = false;
      } else if (tool) {
        app_->cancel();
      } else {
        app_->workbench.select({});
      }
      return true;
    case GLFW_KEY_ENTER:
    case GLFW_KEY_KP_ENTER:
      return tool && tool->accept();
    case GLFW_KEY_BACKSPACE:
      return tool && tool->step_back();
    default:
      return false;
  }
}

void ViewerCore::take_mouse(const Layout& layout) {
  const ImGuiIO& io = ImGui::GetIO();
  const ViewCamera& camera = app_->view.camera();
  events_.set_handlers(handlers_of(*app_, app_->tool));
  PointerEvent event;
  event.pixel = {static_cast<double>(io.MousePos.x - layout.scene.min().x()),
                 static_cast<double>(io.MousePos.y - layout.scene.min().y())};
  event.moved = {static_cast<double>(io.MouseDelta.x), static_cast<double>(io.MouseDelta.y)};
  event.shift = io.KeyShift;
  event.control = io.KeyCtrl;
  const bool is_over =
      !io.WantCaptureMouse && layout.scene.contains(Eigen::Vector2f(io.MousePos.x, io.MousePos.y));
  constexpr std::array<Button, 3> kButtons = {Button::kLeft, Button::kRight, Button::kMiddle};
  for (int i = 0; i < 3; ++i) {
    event.button = kButtons[static_cast<std::size_t>(i)];
    if (is_over && ImGui::IsMouseDoubleClicked(i)) events_.double_click(camera, event);
    if (is_over && ImGui::IsMouseClicked(i)) events_.press(camera, event);
    if (ImGui::IsMouseDown(i)) events_.drag(camera, event);
    if (ImGui::IsMouseReleased(i)) events_.release(camera, event);
  }
  if (is_over && io.MouseWheel != 0.0F) {
    events_.scroll(camera, event, static_cast<double>(io.MouseWheel));
  }
  if (!is_over) {
    app_->workbench.hover(std::nullopt);
  } else if (!events_.is_dragging() && event.moved.squaredNorm() > 0.0) {
    events_.hover(camera, event);
  }
}

}  // namespace geomap::viewer
