// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/key_queue.hpp"

#include <backends/imgui_impl_glfw.h>
#include <imgui.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <string>

namespace geomap::viewer {
namespace {

// GLFW numbers keys by their place on an American keyboard: Z and Y change places on a German one.
int key_by_name(int key, int scancode) {
  const char* text = glfwGetKeyName(key, scancode);
  const std::string name = text ? text : "";
  if (name.size() != 1 || name[0] < 'a' || name[0] > 'z') return key;
  return GLFW_KEY_A + (name[0] - 'a');
}

}  // namespace

std::vector<KeyPress> KeyQueue::deliver(GLFWwindow* window) {
  std::vector<KeyPress> pressed;
  std::set<int> changed;
  bool has_control = false;
  while (!events_.empty()) {
    const Event event = events_.front();
    if (event.character != 0) {
      // With Ctrl held Dear ImGui would drop it.
      if (has_control) break;
      ImGui_ImplGlfw_CharCallback(window, event.character);
    } else {
      if (!changed.insert(event.key).second) break;
      has_control = has_control || (event.mods & GLFW_MOD_CONTROL) != 0;
      ImGui_ImplGlfw_KeyCallback(window, event.key, event.scancode, event.action, event.mods);
      if (event.action == GLFW_PRESS) {
        pressed.push_back({key_by_name(event.key, event.scancode),
                           (event.mods & GLFW_MOD_CONTROL) != 0,
                           (event.mods & GLFW_MOD_SHIFT) != 0});
      }
    }
    events_.pop_front();
  }
  return pressed;
}

}  // namespace geomap::viewer
