// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <set>
#include <vector>

#include "viewer/viewer_core.hpp"

struct GLFWwindow;

namespace geomap::viewer {

/// @brief Keys between GLFW and Dear ImGui, which looks at them once a frame: what changes twice
/// within one frame, as a short press does while a picture is being drawn, waits for the next.
class KeyQueue {
 public:
  void add_key(int key, int scancode, int action, int mods) {
    events_.push_back({key, scancode, action, mods, 0});
  }
  void add_character(unsigned character) { events_.push_back({0, 0, 0, 0, character}); }

  /// @brief Hands to Dear ImGui what one frame can take. @return what was pressed, letters as they
  /// stand on the keyboard in use.
  std::vector<KeyPress> deliver(GLFWwindow* window);
  bool empty() const { return events_.empty(); }

 private:
  struct Event {
    int key, scancode, action, mods;
    unsigned character;  // 0: a key
  };

  std::deque<Event> events_;
};

}  // namespace geomap::viewer
