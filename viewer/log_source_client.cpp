// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/log_source_client.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "mapping/map_journal.hpp"
#include "mapping/operator_name.hpp"
#include "messaging/channels.hpp"
#include "viewer/exact_map_messages.hpp"
#include "viewer/log_reel_client.hpp"
#include "viewer/log_survey_client.hpp"
#include "viewer/view_snapshot.hpp"

namespace geomap::viewer {
namespace {

namespace channels = messaging::channels;
using namespace std::chrono_literals;

constexpr auto kMostWork = 15ms;                      // of one update
constexpr double kSlowest = 0.01, kFastest = 1000.0;  // times real time

// A scene with nothing in it, that everybody who has drawn the other one takes for a new one.
SceneModel emptied(const SceneModel& scene) {
  SceneModel empty;
  empty.map.stamp = scene.map.stamp + 1;
  empty.map.veto_stamp = scene.map.veto_stamp + 1;
  empty.points.stamp = scene.points.stamp + 1;
  empty.frame.stamp = scene.frame.stamp + 1;
  empty.planes.stamp = scene.planes.stamp + 1;
  empty.track.stamp = scene.track.stamp + 1;
  return empty;
}

class LogSource : public MapSource, public Playback {
 public:
  explicit LogSource(std::filesystem::path file)
      : file_(std::move(file)), survey_(file_.string()) {}

  std::string title() const override {
    return file_.filename().string() + (lacks_map() ? " (holds no map)" : "");
  }
  bool update(SceneModel& scene, Clock::time_point now) override;
  bool has_more() const override {
    return !has_failed_ && (!survey_.is_done() || goal_ || is_stepping_ || is_behind_);
  }

  void edit(const mapping::EditCommand& command) override {
    refuse(command.command,
           "a log cannot be edited: open the map.lcmlog that geomap-replay makes of it");
  }
  std::vector<Outcome> take_outcomes() override { return std::exchange(outcomes_, {}); }
  const std::vector<HistoryEntry>& history() const override {
    return coming_ || !reel_ ? former_history_ : reel_->history();
  }

  std::int64_t save(const std::string& where) override {
    const std::int64_t number = numbers_.next();
    if (coming_) {
      refuse(number, "the log is being read back: save the map when that is done");
    } else if (const mapping::GeometricMap* map = folded_map()) {
      outcomes_.push_back(viewer::save(*map, where, number));
    } else {
      refuse(number, "this log does not hold the exact map: geomap-replay makes one of it");
    }
    return number;
  }
  std::string default_save_name() const override {
    return (file_.parent_path() / (file_.stem().string() + "_map.lcmlog")).string();
  }
  std::string save_prompt() const override { return "file"; }
  mapping::MapSnapshot snapshot(const SceneModel& scene) const override {
    const mapping::GeometricMap* map = coming_ ? nullptr : folded_map();  // else half-read
    return map ? mapping::snapshot_of(*map) : snapshot_of(scene.map);
  }
  mapping::MapSnapshot exact_snapshot(const SceneModel& scene) const override {
    if (coming_) throw std::runtime_error("the log is being read back: try again when it is done");
    if (folded_map()) return snapshot(scene);
    throw std::runtime_error("JSON needs the exact map: geomap-replay makes one of this log");
  }

  Playback* playback() override { return this; }
  double duration() const override { return survey_.duration(); }
  double position() const override { return goal_ ? std::min(*goal_, duration()) : position_; }
  bool is_playing() const override { return is_playing_; }
  void play(bool on) override {
    is_playing_ = on;
    if (on) has_failed_ = false;
    const bool is_at_end = reel_ && !reel_->next() && !goal_;
    if (on && is_at_end) seek(0.0);
  }
  double speed() const override { return speed_; }
  void set_speed(double times) override {
    if (std::isfinite(times)) speed_ = std::clamp(times, kSlowest, kFastest);
  }
  void seek(double seconds) override;
  void step() override;
  double progress() const override;

 private:
  bool open();
  void rewind(const SceneModel& scene);
  std::unique_ptr<LogReel> new_reel();
  bool take_over(SceneModel& scene);
  bool read(Clock::time_point now, Clock::time_point end, SceneModel& scene);
  bool is_wanted(const LogReel::Event& event) const;
  void note_end();

  // The map that is folded out of the log, as far as it was read.
  const mapping::GeometricMap* folded_map() const { return reel_ ? reel_->folded_map() : nullptr; }
  bool has_map() const {
    return survey_.has(channels::kMapDelta) || survey_.has(channels::kMapSnapshot);
  }
  bool lacks_map() const {
    return survey_.is_done() && !has_map() && !survey_.has(channels::kPlanes);
  }
  void refuse(std::int64_t command, const std::string& why) {
    outcomes_.push_back({.command = command, .is_done = false, .text = why});
  }

  std::filesystem::path file_;
  LogSurvey survey_;
  std::unique_ptr<LogReel> reel_;     // null until the survey is done
  std::optional<SceneModel> coming_;  // while it is read again from the beginning

  double position_ = 0.0, speed_ = 1.0;
  bool is_playing_ = true, must_rewind_ = false;
  std::optional<double> goal_;  // of a seek [s]
  double began_ = 0.0;          // where the seek did [s]
  bool is_stepping_ = false, has_stepped_ = false;
  bool is_behind_ = false;   // reading was cut short by the end of its time
  bool has_failed_ = false;  // to open the log again; until it is to be played once more
  std::string step_channel_;
  std::optional<Clock::time_point> updated_;

  std::vector<Outcome> outcomes_;
  std::vector<HistoryEntry> former_history_;  // shown while it is read again
  mapping::CommandNumbers numbers_;
};

bool LogSource::update(SceneModel& scene, Clock::time_point now) {
  const Clock::time_point end = Clock::now() + kMostWork;
  if (!survey_.is_done() && !survey_.read_until(end)) return false;
  if (!reel_ && !open()) return false;
  if (std::exchange(must_rewind_, false)) rewind(scene);
  const std::chrono::duration<double> passed = now - updated_.value_or(now);
  updated_ = now;
  if (is_playing_ && !goal_ && !is_stepping_) position_ += speed_ * passed.count();
  bool is_changed = read(now, end, coming_ ? *coming_ : scene);
  if (coming_ && goal_) return false;
  is_changed = take_over(scene) || is_changed;
  is_changed = reel_->show(now, scene) || is_changed;
  if (!goal_) is_changed = reel_->show_newest_frame(scene) || is_changed;
  return is_changed;
}

// What was read again is shown in the place of the former scene.
bool LogSource::take_over(SceneModel& scene) {
  if (!coming_) return false;
  scene = std::move(*coming_);
  coming_.reset();
  return true;
}

// Null, and time stands still, when the file cannot be opened any more.
std::unique_ptr<LogReel> LogSource::new_reel() {
  try {
    return std::make_unique<LogReel>(file_.string(), !has_map());
  } catch (const std::exception& error) {
    refuse(0, error.what());
    has_failed_ = true;
    is_playing_ = is_stepping_ = false;
    goal_.reset();
    return nullptr;
  }
}

bool LogSource::open() {
  if (has_failed_) return false;
  for (const char* channel : {channels::kKeyframe, channels::kPlanes, channels::kRgbdFrame}) {
    if (step_channel_.empty() && survey_.has(channel)) step_channel_ = channel;
  }
  if (step_channel_.empty()) step_channel_ = survey_.commonest();
  reel_ = new_reel();
  if (!reel_) return false;
  if (lacks_map()) {
    refuse(0,
           "this log holds no map: run geomap-replay LOG -o DIR --log-out DERIVED.lcmlog and "
           "open DERIVED.lcmlog");
  }
  return true;
}

void LogSource::rewind(const SceneModel& scene) {
  std::unique_ptr<LogReel> reel = new_reel();
  if (!reel) {
    position_ = reel_->time();
    return;
  }
  if (!coming_) former_history_ = reel_->history();
  coming_ = emptied(scene);
  reel_ = std::move(reel);
}

// Takes events as long as they are wanted and there is time.
bool LogSource::read(Clock::time_point now, Clock::time_point end, SceneModel& scene) {
  bool is_changed = false;
  is_behind_ = false;
  while (reel_->next() && is_wanted(*reel_->next())) {
    if (Clock::now() >= end) {
      // Slower than it should be: time waits.
      if (!goal_) position_ = reel_->time();
      is_behind_ = true;
      return is_changed;
    }
    has_stepped_ = has_stepped_ || reel_->next()->message.channel == step_channel_;
    is_changed = reel_->take_next(now, scene) || is_changed;
  }
  note_end();
  return is_changed;
}

// A step goes on until just before the key frame after the next one, so that what became of the
// next one is seen too.
bool LogSource::is_wanted(const LogReel::Event& event) const {
  if (goal_) return event.time <= *goal_;
  if (is_stepping_) {
    return !has_stepped_ || event.message.channel != step_channel_;
  }
  return is_playing_ && event.time <= position_;
}

// All that was wanted has been read.
void LogSource::note_end() {
  if (goal_) position_ = std::min(*goal_, duration());
  if (is_stepping_) position_ = reel_->time();
  goal_.reset();
  is_stepping_ = false;
  if (reel_->next()) return;
  position_ = duration();
  is_playing_ = false;
}

void LogSource::seek(double seconds) {
  if (!std::isfinite(seconds)) return;
  goal_ = std::max(0.0, seconds);
  is_stepping_ = has_failed_ = false;
  const double read = reel_ ? reel_->time() : 0.0;
  must_rewind_ = must_rewind_ || *goal_ < read;
  began_ = must_rewind_ ? 0.0 : read;
}

void LogSource::step() {
  is_playing_ = false;
  if (goal_) return;
  is_stepping_ = true;
  has_stepped_ = has_failed_ = false;
}

double LogSource::progress() const {
  if (!survey_.is_done()) return survey_.progress();
  if (!goal_) return 1.0;
  const double read = must_rewind_ || !reel_ ? began_ : reel_->time();
  const double way = std::min(*goal_, duration()) - began_;
  return way > 0.0 ? std::clamp((read - began_) / way, 0.0, 0.999) : 0.999;
}

}  // namespace

std::unique_ptr<MapSource> open_log(const std::filesystem::path& file) {
  return std::make_unique<LogSource>(file);
}

}  // namespace geomap::viewer
