// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/log_reel_client.hpp"

#include <exception>

#include "viewer/exact_map_messages.hpp"

namespace geomap::viewer {

LogReel::LogReel(const std::string& log, bool is_folded) : reader_(log) {
  if (is_folded) folded_.emplace();
  read_next();
}

void LogReel::read_next() {
  auto event = reader_.next();
  next_.reset();
  if (!event) return;
  const double time = clock_.note(event->log_utime);
  next_ = Event{time, std::move(*event)};
}

bool LogReel::take_next(Clock::time_point now, SceneModel& scene) {
  const messaging::LogEvent& event = next_->message;
  const bool is_changed = messages_.take(event.channel, event.data, now, scene);
  if (folded_) fold(event);
  time_ = next_->time;
  read_next();
  if (!next_ && folded_ && folded_->finish()) is_fold_shown_ = false;
  return is_changed;
}

void LogReel::fold(const messaging::LogEvent& event) {
  try {
    if (folded_->take(event.channel, event.data)) is_fold_shown_ = false;
  } catch (const std::exception&) {
    // As geomap-mapper does, which goes on without the message.
  }
}

bool LogReel::show(Clock::time_point now, SceneModel& scene) {
  const bool is_changed = messages_.poll(now, scene);
  if (is_fold_shown_) return is_changed;
  is_fold_shown_ = true;
  folded_history_ = history_of(folded_->map());
  viewer::show(folded_->map(), scene.map);
  return true;
}

}  // namespace geomap::viewer
