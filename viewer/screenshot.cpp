// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/screenshot.hpp"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <stdexcept>
#include <thread>
#include <utility>

#include "viewer/framebuffer.hpp"
#include "viewer/offscreen.hpp"

namespace geomap::viewer {
namespace {

using namespace std::chrono_literals;

constexpr int kFrames = 3;  // until Dear ImGui has settled

class OffscreenGui {
 public:
  OffscreenGui() {
    ImGui::CreateContext();
    ImGui_ImplOpenGL3_Init("#version 330");
  }
  ~OffscreenGui() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
  }
  OffscreenGui(const OffscreenGui&) = delete;
  OffscreenGui& operator=(const OffscreenGui&) = delete;
};

double seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

// Until something is there, and nothing more has come for a while.
void wait_for_scene(ViewerCore& core, const ScreenshotOptions& options) {
  const Clock::time_point begin = Clock::now();
  Clock::time_point changed = begin;
  const auto stamps = [&core] {
    const SceneModel& scene = core.app().workbench.scene();
    return std::pair(scene.map.stamp, scene.points.stamp);
  };
  auto known = stamps();
  while (true) {
    const Clock::time_point now = Clock::now();
    core.update(now);
    if (stamps() != known) {
      known = stamps();
      changed = now;
    }
    const Playback* playback = core.app().workbench.source().playback();
    if (playback && playback->progress() < 1.0) changed = now;
    const bool is_empty = core.app().workbench.scene().bounds().isEmpty();
    if (!is_empty && changed != now && seconds(now - changed) >= options.settle) return;
    if (changed != now && seconds(now - begin) > options.patience) {
      if (!is_empty) return;
      throw std::runtime_error("nothing to show has come from " +
                               core.app().workbench.source().title());
    }
    if (!playback) std::this_thread::sleep_for(10ms);
  }
}

}  // namespace

Image take_screenshot(std::unique_ptr<MapSource> source, const Preferences& preferences,
                      const ScreenshotOptions& options) {
  const OffscreenContext context;
  const OffscreenGui gui;
  ViewerCore core(std::move(source), preferences, static_cast<float>(options.scale));
  core.app().are_panels_shown = options.has_panels;
  core.app().view.camera().resize(options.width, options.height);
  wait_for_scene(core, options);
  Framebuffer framebuffer(options.width, options.height);
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(options.width), static_cast<float>(options.height)};
  io.MousePos = {-1.0F, -1.0F};
  for (int frame = 0; frame < kFrames; ++frame) {
    if (frame == 1) options.prepare(core.app());  // the size of the drawing is known by now
    io.DeltaTime = 1.0F / 30.0F;
    core.draw(framebuffer.id(), options.width, options.height, Clock::now());
  }
  return framebuffer.read();
}

}  // namespace geomap::viewer
