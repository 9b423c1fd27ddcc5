// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/key_queue.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <set>

namespace geomap::viewer {
namespace {

bool is_held_with_others(int key) {
  return key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER;
}

}  // namespace

std::vector<KeyQueue::Event> KeyQueue::take_frame() {
  std::vector<Event> frame;
  std::set<int> changed;
  bool has_press = false, has_control = false;
  while (!events_.empty()) {
    const Event& event = events_.front();
    const bool is_key = event.character == 0;
    if (!is_key && has_control) break;
    if (is_key && has_press && is_held_with_others(event.key)) break;
    if (is_key && !changed.insert(event.key).second) break;
    has_press =
        has_press || (is_key && event.action == GLFW_PRESS && !is_held_with_others(event.key));
    has_control = has_control || (event.mods & GLFW_MOD_CONTROL) != 0;
    frame.push_back(event);
    events_.pop_front();
  }
  return frame;
}

}  // namespace geomap::viewer
