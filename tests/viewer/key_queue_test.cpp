// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/key_queue.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace geomap::viewer {
namespace {

using ::testing::ElementsAre;

KeyQueue::Event key(int key, int action, int mods = 0) { return {key, 0, action, mods, 0}; }
KeyQueue::Event character(unsigned c) { return {0, 0, 0, 0, c}; }

/// What each frame gets: "+A" pressed, "-A" let go, "'a" a character, "Ctrl" the left one.
std::vector<std::string> frames_of(std::initializer_list<KeyQueue::Event> events) {
  KeyQueue queue;
  for (const auto& event : events) queue.add(event);
  std::vector<std::string> frames;
  while (!queue.empty()) {
    std::string& text = frames.emplace_back();
    for (const KeyQueue::Event& event : queue.take_frame()) {
      const std::string name = event.key == GLFW_KEY_LEFT_CONTROL
                                   ? "Ctrl"
                                   : std::string(1, static_cast<char>(event.key));
      if (event.character != 0) {
        text += std::string("'") + static_cast<char>(event.character);
      } else {
        text += (event.action == GLFW_PRESS ? "+" : "-") + name;
      }
    }
    if (text.empty()) break;  // it would never end
  }
  return frames;
}

TEST(KeyQueue, AShortPressIsHeldForAFrame) {
  EXPECT_THAT(frames_of({key('A', GLFW_PRESS), key('A', GLFW_RELEASE)}), ElementsAre("+A", "-A"));
}

TEST(KeyQueue, WhatIsHeldWithAKeyIsStillHeldInItsFrame) {
  EXPECT_THAT(
      frames_of({key(GLFW_KEY_LEFT_CONTROL, GLFW_PRESS), key('A', GLFW_PRESS, GLFW_MOD_CONTROL),
                 key(GLFW_KEY_LEFT_CONTROL, GLFW_RELEASE, GLFW_MOD_CONTROL),
                 key('A', GLFW_RELEASE)}),
      ElementsAre("+Ctrl+A", "-Ctrl-A"));
}

TEST(KeyQueue, AWordIsTypedInOrderAfterAChord) {
  EXPECT_THAT(
      frames_of({key('A', GLFW_PRESS, GLFW_MOD_CONTROL), key('A', GLFW_RELEASE, GLFW_MOD_CONTROL),
                 key(GLFW_KEY_LEFT_CONTROL, GLFW_RELEASE, GLFW_MOD_CONTROL), key('X', GLFW_PRESS),
                 character('x'), key('X', GLFW_RELEASE)}),
      ElementsAre("+A", "-A-Ctrl+X", "'x-X"));
}

}  // namespace
}  // namespace geomap::viewer
