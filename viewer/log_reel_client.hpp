// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "messaging/log_event.hpp"
#include "messaging/log_reader.hpp"
#include "viewer/folded_map_messages.hpp"
#include "viewer/log_survey_client.hpp"
#include "viewer/scene_messages.hpp"

namespace geomap::viewer {

/// @brief A log that is read from front to back into a scene.
class LogReel {
 public:
  /// @param is_folded the log's planes are folded into a map, since it holds none.
  LogReel(const std::string& log, bool is_folded);

  struct Event {
    double time = 0.0;  // [s] from the beginning
    messaging::LogEvent message;
  };
  /// @brief The event that comes next; nothing at the end.
  const std::optional<Event>& next() const { return next_; }
  /// @brief Takes it over. @return true when a layer has changed.
  bool take_next(Clock::time_point now, SceneModel& scene);
  /// @brief After some events: shows what they have made of a folded map, and what is due in time.
  bool show(Clock::time_point now, SceneModel& scene);
  bool show_newest_frame(SceneModel& scene) { return messages_.show_newest_frame(scene); }

  double time() const { return time_; }  // of the last event taken [s]
  const std::vector<HistoryEntry>& history() const {
    return folded_ ? folded_history_ : messages_.history();
  }
  /// @brief Null where the log holds a map of its own.
  const mapping::GeometricMap* folded_map() const { return folded_ ? &folded_->map() : nullptr; }

 private:
  void read_next();
  void fold(const messaging::LogEvent& event);

  messaging::LogReader reader_;
  LogTime clock_;
  std::optional<Event> next_;
  double time_ = 0.0;
  SceneMessages messages_{[](const char*) {}};  // a log answers nobody
  std::optional<FoldedMap> folded_;
  std::vector<HistoryEntry> folded_history_;
  bool is_fold_shown_ = true;
};

}  // namespace geomap::viewer
