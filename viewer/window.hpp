// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "viewer/map_source.hpp"
#include "viewer/preferences.hpp"

namespace geomap::viewer {

struct WindowOptions {
  int width = 1280, height = 800;  // [px at scale 1]
  double scale = 0.0;              // of text and lines; 0: as the display says
  std::function<bool()> is_to_end = [] { return false; };  // asked several times a second
  // What is in a file; throws std::runtime_error, one line.
  std::function<std::unique_ptr<MapSource>(const std::filesystem::path&)> open = {};
};

/// @brief Shows the viewer in a window until it is closed. Draws when there is something new.
/// @return the preferences as they are then.
/// @throws std::runtime_error, one line that says what to do, where no window can be opened.
Preferences run_window(std::unique_ptr<MapSource> source, const Preferences& preferences,
                       const WindowOptions& options);

}  // namespace geomap::viewer
