// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/window.hpp"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
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
#include "viewer/key_queue.hpp"
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
    // A size in pixels, larger with larger text, but no larger than the screen.
    const double scale = std::max(1.0, options.scale);
    const GLFWvidmode* mode = glfwGetVideoMode(glfwGetPrimaryMonitor());
    const int width =
        std::min(static_cast<int>(options.width * scale), mode ? mode->width : 1 << 14);
    const int height =
        std::min(static_cast<int>(options.height * scale), mode ? mode->height : 1 << 14);
    window_ = glfwCreateWindow(width, height, "geomap", nullptr, nullptr);
    if (!window_) {
      const std::string why = glfw_error();
      glfwTerminate();
      throw std::runtime_error("no window with OpenGL 3.3 can be opened: " + why);
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    set_callbacks();
    ImGui::CreateContext();
    // The keys come by way of the queue.
    ImGui_ImplGlfw_InitForOpenGL(window_, false);
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
  KeyQueue& keys() { return keys_; }
  /// @brief A file that was dropped on it; empty: none.
  std::filesystem::path take_file() { return std::exchange(file_, {}); }

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
  static GlfwWindow& note(GLFWwindow* window) {
    auto& self = *static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window));
    self.has_input_ = true;
    return self;
  }

  void set_callbacks() {
    glfwSetWindowUserPointer(window_, this);
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double, double) { note(w); });
    glfwSetCursorEnterCallback(window_, [](GLFWwindow* w, int entered) {
      note(w);
      ImGui_ImplGlfw_CursorEnterCallback(w, entered);
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int mods) {
      note(w);
      ImGui_ImplGlfw_MouseButtonCallback(w, button, action, mods);
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double dx, double dy) {
      note(w);
      ImGui_ImplGlfw_ScrollCallback(w, dx, dy);
    });
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int scancode, int action, int mods) {
      note(w).keys_.add({key, scancode, action, mods, 0});
    });
    glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned character) {
      note(w).keys_.add({0, 0, 0, 0, character});
    });
    glfwSetWindowFocusCallback(window_, [](GLFWwindow* w, int focused) {
      note(w);
      ImGui_ImplGlfw_WindowFocusCallback(w, focused);
    });
    glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** paths) {
      if (count > 0) note(w).file_ = paths[0];
    });
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) { note(w); });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* w) { note(w); });
  }

  GLFWwindow* window_ = nullptr;
  bool has_input_ = true;
  KeyQueue keys_;
  std::filesystem::path file_;
  std::array<int, 4> place_{};  // before it filled the screen
};

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
    write_png(file, read_pixels(0, width, height));
    app_.workbench.tell(Level::kGood, "picture written to " + file);
  }

  void film(int width, int height, Clock::time_point now) {
    if (!app_.is_filming && movie_) {
      const std::filesystem::path path = movie_->path();
      const std::string fault = movie_->finish();
      movie_.reset();
      app_.workbench.tell(fault.empty() ? Level::kGood : Level::kFailing,
                          fault.empty() ? fmt::format("film: {}", path.string()) : fault);
    }
    if (!is_due(now)) return;
    if (!movie_) movie_.emplace(name_by_time(), width, height);
    movie_->add(read_pixels(0, width, height));
    next_ = now + std::chrono::duration_cast<Clock::duration>(
                      std::chrono::duration<double>(1.0 / Movie::kFramesPerSecond));
  }

  App& app_;
  std::optional<Movie> movie_;
  Clock::time_point next_;
};

// GLFW numbers keys by their place on an American keyboard: Z and Y change places on a German one.
int key_by_name(int key, int scancode) {
  const char* text = glfwGetKeyName(key, scancode);
  const std::string name = text ? text : "";
  if (name.size() != 1 || name[0] < 'a' || name[0] > 'z') return key;
  return GLFW_KEY_A + (name[0] - 'a');
}

// The window of one source, until it is closed or another file is to be shown.
class Session {
 public:
  Session(GlfwWindow& window, std::unique_ptr<MapSource> source, const Preferences& preferences,
          double scale)
      : window_(window),
        core_(std::move(source), preferences, static_cast<float>(scale)),
        recorder_(core_.app()) {
    glfwSetWindowTitle(window.get(), ("geomap: " + app().workbench.source().title()).c_str());
  }

  App& app() { return core_.app(); }

  void run(const WindowOptions& options) {
    while (!app().wants_quit && app().wants_open.empty() && !options.is_to_end()) {
      wait();
      if (glfwWindowShouldClose(window_.get()) == GLFW_TRUE) {
        glfwSetWindowShouldClose(window_.get(), GLFW_FALSE);
        app().quit();
        frames_left_ = kFramesAfterInput;
      }
      const std::filesystem::path dropped = window_.take_file();
      if (!dropped.empty()) app().wants_open = dropped;
      draw_if_due(Clock::now());
    }
  }

 private:
  void wait() {
    const bool is_busy = frames_left_ > 0 || core_.is_moving() || !window_.keys().empty() ||
                         app().workbench.source().has_more();
    if (is_busy) {
      glfwPollEvents();
    } else {
      glfwWaitEventsTimeout(kNap);
    }
  }

  void deliver_keys() {
    for (const KeyQueue::Event& event : window_.keys().take_frame()) {
      if (event.character != 0) {
        ImGui_ImplGlfw_CharCallback(window_.get(), event.character);
        continue;
      }
      ImGui_ImplGlfw_KeyCallback(window_.get(), event.key, event.scancode, event.action,
                                 event.mods);
      if (event.action != GLFW_PRESS) continue;
      core_.press({key_by_name(event.key, event.scancode), (event.mods & GLFW_MOD_CONTROL) != 0,
                   (event.mods & GLFW_MOD_SHIFT) != 0});
    }
  }

  void draw_if_due(Clock::time_point now) {
    const bool has_changed = core_.update(now);
    if (window_.take_input()) frames_left_ = kFramesAfterInput;
    const bool has_keys = !window_.keys().empty();
    if (frames_left_ == 0 && !has_changed && !has_keys && !core_.is_moving() &&
        !recorder_.is_due(now)) {
      return;
    }
    frames_left_ = std::max(0, frames_left_ - 1);
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_.get(), &width, &height);
    if (width <= 0 || height <= 0) return;  // an icon
    deliver_keys();
    ImGui_ImplGlfw_NewFrame();
    core_.draw(0, width, height, now);
    recorder_.take(width, height, now);
    glfwSwapBuffers(window_.get());
    if (std::exchange(app().wants_fullscreen, false)) window_.toggle_fullscreen();
  }

  GlfwWindow& window_;
  ViewerCore core_;
  Recorder recorder_;
  int frames_left_ = kFramesAfterInput;
};

}  // namespace

Preferences run_window(std::unique_ptr<MapSource> source, const Preferences& preferences,
                       const WindowOptions& options) {
  std::signal(SIGPIPE, SIG_IGN);  // of an ffmpeg that has ended: seen when writing to it
  GlfwWindow window(options);
  const double scale = options.scale > 0.0 ? options.scale : window.content_scale();
  auto session = std::make_unique<Session>(window, std::move(source), preferences, scale);
  while (true) {
    session->run(options);
    App& app = session->app();
    app.store_preferences();
    if (app.wants_open.empty()) return app.preferences;
    const std::filesystem::path file = std::exchange(app.wants_open, {});
    try {
      auto opened = options.open(file);
      const Preferences kept = app.preferences;
      session.reset();  // only one at a time has Dear ImGui
      session = std::make_unique<Session>(window, std::move(opened), kept, scale);
    } catch (const std::exception& error) {
      session->app().workbench.tell(Level::kFailing, error.what());
    }
  }
}

}  // namespace geomap::viewer
