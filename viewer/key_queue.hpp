// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <vector>

namespace geomap::viewer {

/// @brief Keys between GLFW and Dear ImGui, which looks once a frame at what is held down. What
/// would be lost then, as a short press while a picture is being drawn, waits for the next frame.
class KeyQueue {
 public:
  /// @brief A key or a character, as GLFW's callbacks have them.
  struct Event {
    int key = 0, scancode = 0, action = 0, mods = 0;
    unsigned character = 0;  // 0: a key
  };

  void add(const Event& event) { events_.push_back(event); }
  bool empty() const { return events_.empty(); }

  /// @brief What one frame can take, in order: no key changes twice in it, none that is held with
  /// others (Shift, Ctrl, Alt, Super) changes after another one was pressed, and no character
  /// comes while Ctrl is held, with which Dear ImGui would drop it.
  std::vector<Event> take_frame();

 private:
  std::deque<Event> events_;
};

}  // namespace geomap::viewer
