// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include "viewer/image.hpp"
#include "viewer/map_source.hpp"
#include "viewer/preferences.hpp"
#include "viewer/viewer_core.hpp"

namespace geomap::viewer {

class Framebuffer;

/// @brief The whole viewer without window or display: for pictures, tests and timings. Mouse and
/// keys are what the caller puts into Dear ImGui's input.
class OffscreenViewer {
 public:
  /// @param width, height of its picture [px]. @param scale of text and lines.
  /// @throws std::runtime_error, one line, when there is no OpenGL.
  OffscreenViewer(std::unique_ptr<MapSource> source, const Preferences& preferences, int width,
                  int height, double scale);
  ~OffscreenViewer();
  OffscreenViewer(const OffscreenViewer&) = delete;
  OffscreenViewer& operator=(const OffscreenViewer&) = delete;

  ViewerCore& core() { return *core_; }
  App& app() { return core_->app(); }

  /// @brief Waits until there is something to show, a log has been read as far as was asked for,
  /// and no more has come for `settle` seconds.
  /// @throws std::runtime_error when nothing has come within `patience` seconds.
  void wait_for_scene(double settle, double patience);
  /// @brief Draws one frame.
  void draw();
  Image image() const;

 private:
  struct Gui;

  std::unique_ptr<Gui> gui_;
  std::unique_ptr<ViewerCore> core_;
  std::unique_ptr<Framebuffer> framebuffer_;
};

}  // namespace geomap::viewer
