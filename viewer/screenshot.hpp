// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "viewer/map_source.hpp"
#include "viewer/preferences.hpp"
#include "viewer/viewer_core.hpp"

namespace geomap::viewer {

struct ScreenshotOptions {
  int width = 1280, height = 800;  // [px]
  double scale = 1.0;              // of text and lines
  double settle = 1.0;             // without anything new, then the picture is taken [s]
  double patience = 10.0;          // for anything at all to come [s]
  bool has_panels = false;
  std::function<void(App&)> prepare = [](App&) {};  // once the scene is there
};

/// @brief A picture of the viewer, without any window or display.
/// @throws std::runtime_error when nothing to show has come in time, or there is no OpenGL.
Image take_screenshot(std::unique_ptr<MapSource> source, const Preferences& preferences,
                      const ScreenshotOptions& options);

}  // namespace geomap::viewer
