// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "viewer/app.hpp"
#include "viewer/event_handler.hpp"
#include "viewer/image.hpp"
#include "viewer/panels.hpp"

namespace geomap::viewer {

class Framebuffer;
class ImageTexture;

/// @brief A key as GLFW numbers them, with what was held down when it was pressed.
struct KeyPress {
  int key = 0;
  bool control = false, shift = false;
};

/// @brief The viewer without a window: draws itself into any framebuffer, and takes
/// mouse and keys from Dear ImGui's input. Needs a current OpenGL 3.3 context as long as it lives.
class ViewerCore {
 public:
  /// @param scale of text and lines, for the display's density: 1 at some 96 dots an inch.
  ViewerCore(std::unique_ptr<MapSource> source, Preferences preferences, float scale);
  ~ViewerCore();
  ViewerCore(const ViewerCore&) = delete;
  ViewerCore& operator=(const ViewerCore&) = delete;

  App& app() { return *app_; }

  /// @brief A key that was pressed, for the actions; none is lost however long a frame takes. Dear
  /// ImGui's fields get theirs by its own input.
  void press(const KeyPress& key) { keys_.push_back(key); }
  /// @brief Takes what has come. @return true when the window is to be drawn anew.
  bool update(Clock::time_point now);
  /// @brief Draws all of the window. Dear ImGui's display size, mouse and keys have been set.
  /// @param framebuffer to draw into, 0 being the window's; width, height of it [px].
  void draw(unsigned framebuffer, int width, int height, Clock::time_point now);
  /// @brief Goes on by itself, as a flight of the camera does: is to be drawn again at once.
  bool is_moving() const;

 private:
  // All that the drawing of the scene depends on, to know when it is another.
  struct SceneKey {
    std::array<Stamp, 6> stamps{};
    Eigen::Matrix4d view_projection = Eigen::Matrix4d::Zero();
    Eigen::Vector2i size = Eigen::Vector2i::Zero();
    Selection selection;
    bool operator==(const SceneKey&) const = default;
  };

  void set_fonts();
  void take_mouse(const Layout& layout);
  void take_keys();
  bool take_tool_key(int key);
  void draw_scene(const Layout& layout);
  void upload_images();
  void show_all_while_untouched();
  SceneKey scene_key() const;

  float scale_;
  std::unique_ptr<App> app_;
  EventDispatcher events_;
  std::vector<KeyPress> keys_;
  std::unique_ptr<Framebuffer> framebuffer_;
  std::unique_ptr<ImageTexture> color_, depth_;
  Stamp image_stamp_ = 0;
  SceneKey drawn_;
  std::size_t point_budget_;
  Eigen::AlignedBox3d shown_;  // what was in view when all was shown last
  std::optional<bool> styled_dark_;
  Clock::time_point status_drawn_;
  std::set<std::string> told_;  // what renderers could not draw
};

}  // namespace geomap::viewer
