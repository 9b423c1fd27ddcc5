// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/offscreen_viewer.hpp"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <chrono>
#include <stdexcept>
#include <thread>
#include <utility>

#include "viewer/framebuffer.hpp"
#include "viewer/offscreen.hpp"

namespace geomap::viewer {
namespace {

using namespace std::chrono_literals;

constexpr float kFrameSeconds = 1.0F / 30.0F;  // for what Dear ImGui times

double seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

}  // namespace

struct OffscreenViewer::Gui {
  Gui(int width, int height) {
    ImGui::CreateContext();
    ImGui_ImplOpenGL3_Init("#version 330");
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
    io.MousePos = {-1.0F, -1.0F};
    io.DeltaTime = kFrameSeconds;
  }
  ~Gui() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
  }
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  OffscreenContext context;
};

OffscreenViewer::OffscreenViewer(std::unique_ptr<MapSource> source, const Preferences& preferences,
                                 int width, int height, double scale)
    : gui_(std::make_unique<Gui>(width, height)),
      core_(
          std::make_unique<ViewerCore>(std::move(source), preferences, static_cast<float>(scale))),
      framebuffer_(std::make_unique<Framebuffer>(width, height)) {}

OffscreenViewer::~OffscreenViewer() = default;

void OffscreenViewer::wait_for_scene(double settle, double patience) {
  const Clock::time_point begin = Clock::now();
  const SceneModel& scene = app().workbench.scene();
  const auto stamps = [&scene] { return std::pair(scene.map.stamp, scene.points.stamp); };
  Clock::time_point changed = begin;
  auto known = stamps();
  while (true) {
    const Clock::time_point now = Clock::now();
    core_->update(now);
    if (stamps() != known) {
      known = stamps();
      changed = now;
    }
    const Playback* playback = app().workbench.source().playback();
    if (playback && playback->progress() < 1.0) continue;  // no patience for one's own work
    const bool is_empty = app().workbench.bounds().isEmpty();
    if (!is_empty && seconds(now - changed) >= settle) return;
    if (seconds(now - begin) > patience) {
      if (!is_empty) return;
      throw std::runtime_error("nothing to show has come from " + app().workbench.source().title());
    }
    std::this_thread::sleep_for(5ms);
  }
}

void OffscreenViewer::draw() {
  core_->draw(framebuffer_->id(), framebuffer_->width(), framebuffer_->height(), Clock::now());
}

Image OffscreenViewer::image() const { return framebuffer_->read(); }

}  // namespace geomap::viewer
