// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "viewer/event_handler.hpp"
#include "viewer/palette.hpp"

namespace geomap::viewer {

/// @brief Lines and words that are drawn over all else. World frame, metres.
struct Overlay {
  struct Line {
    Eigen::Vector3d a, b;
    Rgba color;
    float width = 2.0F;  // [px at scale 1]
  };
  struct Dot {
    Eigen::Vector3d position;
    Rgba color;
    float radius = 4.0F;  // [px at scale 1]
  };
  struct Text {
    Eigen::Vector3d position;
    std::string text;
    Rgba color;
  };
  std::vector<Line> lines;
  std::vector<Dot> dots;
  std::vector<Text> texts;
  std::optional<Eigen::AlignedBox2d> rectangle;  // of the picture [px]
};

/// @brief A way of working with the mouse: it is at work from begin() until it says it is done.
class Tool : public EventHandler {
 public:
  /// @brief Starts anew. @return what is missing, in words; empty when it can go on.
  virtual std::string begin() = 0;
  virtual void end() {}
  /// @brief For the operator: what to do next.
  virtual std::string hint() const = 0;
  virtual void add_overlay(const ViewCamera&, const Theme&, Overlay&) const {}
  /// @brief Enter, Backspace. @return true when it meant something.
  virtual bool accept() { return false; }
  virtual bool step_back() { return false; }
  /// @brief True when there is nothing more to do with it.
  virtual bool is_done() const = 0;
};

}  // namespace geomap::viewer
