// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewer/map_source.hpp"

namespace geomap::viewer {

/// @brief One thing that the operator is told all the time.
struct StatusItem {
  Level level = Level::kGood;
  std::string text;
  std::string detail;    // more of it, for who asks; several lines
  bool is_known = true;  // false: nothing has been heard of it yet, neither good nor bad
};

/// @brief Link, registration, map, frames and processes in plain words.
std::vector<StatusItem> status_items(const SceneModel& scene, const MapSource& source,
                                     Clock::time_point now);

/// @brief A warning that what is seen is old, that the mapper does not answer, or that nothing has
/// come yet; nothing when all is fresh. Only of a live source.
std::optional<std::string> stale_warning(const SceneModel& scene, const MapSource& source,
                                         Clock::time_point now);

/// @brief "0.4 s", "12 s", "3 min", "2 h".
std::string age_text(double seconds);
/// @brief "812 B", "12.3 kB", "4.5 MB".
std::string bytes_text(std::int64_t bytes);

}  // namespace geomap::viewer
