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

  void edit(const mapping::EditCommand& command) override {
    refuse(command.command,
           "a log cannot be edited: open the map.lcmlog that geomap-replay makes of it");
  }
  std::vector<Outcome> take_outcomes() override { return std::exchange(outcomes_, {}); }
  const std::vector<HistoryEntry>& history() const override {
    return reel_ ? reel_->history() : no_history_;
  }

  std::int64_t save(const std::string& where) override {
    const std::int64_t number = numbers_.next();
    if (const mapping::GeometricMap* map = folded_map()) {
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
    const mapping::GeometricMap* map = folded_map();
    return map ? mapping::snapshot_of(*map) : snapshot_of(scene.map);
  }
  mapping::MapSnapshot exact_snapshot(const SceneModel& scene) const override {
    if (folded_map()) return snapshot(scene);
    throw std::runtime_error("JSON needs the exact map: geomap-replay makes one of this log");
  }

  Playback* playback() override { return this; }
  double duration() const override { return survey_.duration(); }
  double position() const override { return goal_ ? std::min(*goal_, duration()) : position_; }
  bool is_playing() const override { return is_playing_; }
  void play(bool on) override {
    is_playing_ = on;
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
  void open();
  void rewind(const SceneModel& scene);
  bool read(Clock::time_point now, Clock::time_point end, SceneModel& scene);
  bool is_wanted(const LogReel::Event& event) const;
  void note_end();

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
  std::string step_channel_;
  std::optional<Clock::time_point> updated_;

  std::vector<Outcome> outcomes_;
  std::vector<HistoryEntry> no_history_;
  mapping::CommandNumbers numbers_;
};

bool LogSource::update(SceneModel& scene, Clock::time_point now) {
  const Clock::time_point end = Clock::now() + kMostWork;
  if (!survey_.is_done() && !survey_.read_until(end)) return false;
  if (!reel_) open();
  if (std::exchange(must_rewind_, false)) rewind(scene);
  const std::chrono::duration<double> passed = now - updated_.value_or(now);
  updated_ = now;
  if (is_playing_ && !goal_ && !is_stepping_) position_ += speed_ * passed.count();
  bool is_changed = read(now, end, coming_ ? *coming_ : scene);
  if (coming_ && goal_) return false;
  if (coming_) {
    scene = std::move(*coming_);
    coming_.reset();
    is_changed = true;
  }
  is_changed = reel_->show(now, scene) || is_changed;
  if (!goal_) is_changed = reel_->show_newest_frame(scene) || is_changed;
  return is_changed;
}

void LogSource::open() {
  for (const char* channel : {channels::kKeyframe, channels::kPlanes, channels::kRgbdFrame}) {
    if (step_channel_.empty() && survey_.has(channel)) step_channel_ = channel;
  }
  reel_ = std::make_unique<LogReel>(file_.string(), !has_map());
  if (lacks_map()) {
    refuse(0,
           "this log holds no map: run geomap-replay LOG -o DIR --log-out DERIVED.lcmlog and "
           "open DERIVED.lcmlog");
  }
}

void LogSource::rewind(const SceneModel& scene) {
  coming_ = emptied(scene);
  reel_ = std::make_unique<LogReel>(file_.string(), !has_map());
}

// Takes events as long as they are wanted and there is time.
bool LogSource::read(Clock::time_point now, Clock::time_point end, SceneModel& scene) {
  bool is_changed = false;
  while (reel_->next() && is_wanted(*reel_->next())) {
    if (Clock::now() >= end) {
      // Slower than it should be: time waits.
      if (!goal_) position_ = reel_->time();
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
    return !has_stepped_ || (event.message.channel != step_channel_ && !step_channel_.empty());
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
  is_stepping_ = false;
  const double read = reel_ ? reel_->time() : 0.0;
  must_rewind_ = must_rewind_ || *goal_ < read;
  began_ = must_rewind_ ? 0.0 : read;
}

void LogSource::step() {
  is_playing_ = false;
  if (goal_) return;
  is_stepping_ = true;
  has_stepped_ = false;
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
