// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/window.hpp"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>
#include <fmt/format.h>
#include <imgui.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <csignal>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "viewer/framebuffer.hpp"
#include "viewer/movie.hpp"
#include "viewer/png_file.hpp"
#include "viewer/viewer_core.hpp"

namespace geomap::viewer {
namespace {

constexpr double kNap = 0.03;         // between two looks at what has come [s]
constexpr int kFramesAfterInput = 3;  // until Dear ImGui has settled

std::string glfw_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "unknown";
}

// GLFW, its window, and Dear ImGui in it.
class GlfwWindow {
 public:
  explicit GlfwWindow(const WindowOptions& options) {
    if (glfwInit() == GLFW_FALSE) {
      throw std::runtime_error(
          "no window can be opened: " + glfw_error() +
          " (is DISPLAY set? without a display --screenshot OUT.png makes a picture)");
    }
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    window_ = glfwCreateWindow(options.width, options.height, "geomap", nullptr, nullptr);
    if (!window_) {
      const std::string why = glfw_error();
      glfwTerminate();
      throw std::runtime_error("no window with OpenGL 3.3 can be opened: " + why);
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    set_callbacks();
    ImGui::CreateContext();
    ImGui_ImplGlfw_InitForOpenGL(window_, true);
    ImGui_ImplOpenGL3_Init("#version 330");
  }
  ~GlfwWindow() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwDestroyWindow(window_);
    glfwTerminate();
  }
  GlfwWindow(const GlfwWindow&) = delete;
  GlfwWindow& operator=(const GlfwWindow&) = delete;

  GLFWwindow* get() const { return window_; }
  double content_scale() const {
    float x = 1.0F, y = 1.0F;
    glfwGetWindowContentScale(window_, &x, &y);
    return static_cast<double>(std::max(x, y));
  }
  bool take_input() { return std::exchange(has_input_, false); }

  void toggle_fullscreen() {
    if (glfwGetWindowMonitor(window_)) {
      glfwSetWindowMonitor(window_, nullptr, place_[0], place_[1], place_[2], place_[3], 0);
      return;
    }
    glfwGetWindowPos(window_, &place_[0], &place_[1]);
    glfwGetWindowSize(window_, &place_[2], &place_[3]);
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    if (!mode) return;
    glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
  }

 private:
  static void note(GLFWwindow* window) {
    static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window))->has_input_ = true;
  }

  // Before Dear ImGui's own, which call these.
  void set_callbacks() {
    glfwSetWindowUserPointer(window_, this);
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double, double) { note(w); });
    glfwSetCursorEnterCallback(window_, [](GLFWwindow* w, int) { note(w); });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int, int, int) { note(w); });
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double, double) { note(w); });
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int, int, int, int) { note(w); });
    glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned) { note(w); });
    glfwSetWindowFocusCallback(window_, [](GLFWwindow* w, int) { note(w); });
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) { note(w); });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* w) { note(w); });
  }

  GLFWwindow* window_ = nullptr;
  bool has_input_ = true;
  std::array<int, 4> place_{};  // before it filled the screen
};

Image read_window(int width, int height) {
  Image image{width, height,
              std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height))};
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
  const auto row = static_cast<std::ptrdiff_t>(3 * width);
  for (int y = 0; y < height / 2; ++y) {
    const auto top = image.rgb.begin() + y * row,
               bottom = image.rgb.begin() + (height - 1 - y) * row;
    std::swap_ranges(top, top + row, bottom);
  }
  return image;
}

// Pictures and films of what has just been drawn.
class Recorder {
 public:
  explicit Recorder(App& app) : app_(app) {}

  bool is_due(Clock::time_point now) const { return app_.is_filming && now >= next_; }

  void take(int width, int height, Clock::time_point now) {
    try {
      if (std::exchange(app_.wants_screenshot, false)) take_screenshot(width, height);
      film(width, height, now);
    } catch (const std::exception& error) {
      app_.is_filming = false;
      movie_.reset();
      app_.workbench.tell(Level::kFailing, error.what());
    }
  }

 private:
  void take_screenshot(int width, int height) {
    const std::string file = name_by_time().string() + ".png";
    write_png(file, read_window(width, height));
    app_.workbench.tell(Level::kGood, "picture written to " + file);
  }

  void film(int width, int height, Clock::time_point now) {
    if (!app_.is_filming && movie_) {
      app_.workbench.tell(Level::kGood, "film written to " + movie_->path().string());
      movie_.reset();
    }
    if (!is_due(now)) return;
    if (!movie_) movie_.emplace(name_by_time(), width, height);
    movie_->add(read_window(width, height));
    next_ = now + std::chrono::duration_cast<Clock::duration>(
                      std::chrono::duration<double>(1.0 / Movie::kFramesPerSecond));
  }

  App& app_;
  std::optional<Movie> movie_;
  Clock::time_point next_;
};

}  // namespace

Preferences run_window(std::unique_ptr<MapSource> source, const Preferences& preferences,
                       const WindowOptions& options) {
  std::signal(SIGPIPE, SIG_IGN);  // of an ffmpeg that has ended: seen when writing to it
  GlfwWindow window(options);
  const double scale = options.scale > 0.0 ? options.scale : window.content_scale();
  ViewerCore core(std::move(source), preferences, static_cast<float>(scale));
  App& app = core.app();
  glfwSetWindowTitle(window.get(), ("geomap: " + app.workbench.source().title()).c_str());
  Recorder recorder(app);
  int frames_left = kFramesAfterInput;
  while (glfwWindowShouldClose(window.get()) == GLFW_FALSE && !app.wants_quit &&
         !options.is_to_end()) {
    if (frames_left > 0 || core.is_moving()) {
      glfwPollEvents();
    } else {
      glfwWaitEventsTimeout(kNap);
    }
    const Clock::time_point now = Clock::now();
    const bool has_changed = core.update(now);
    if (window.take_input()) frames_left = kFramesAfterInput;
    if (frames_left == 0 && !has_changed && !core.is_moving() && !recorder.is_due(now)) continue;
    frames_left = std::max(0, frames_left - 1);
    int width = 0, height = 0;
    glfwGetFramebufferSize(window.get(), &width, &height);
    ImGui_ImplGlfw_NewFrame();
    core.draw(0, width, height, now);
    recorder.take(width, height, now);
    glfwSwapBuffers(window.get());
    if (std::exchange(app.wants_fullscreen, false)) window.toggle_fullscreen();
  }
  app.store_preferences();
  return app.preferences;
}

}  // namespace geomap::viewer
