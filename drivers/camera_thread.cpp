// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/camera_thread.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <utility>

#include "drivers/frame_source.hpp"

namespace geomap::drivers {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kPatience{50};  // of one call

Clock::duration duration(double seconds) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

/// What both threads share; it lives as long as either of them.
class CameraThread::State {
 public:
  State(Open open, const CameraThreadConfig& config) : open_(std::move(open)), config_(config) {}

  void run() {
    while (!is_stopped()) {
      try {
        note_call();
        const std::unique_ptr<RgbdCamera> camera = open_();
        put(CameraOpened{camera->description()});
        serve(*camera);
        note_call();  // closing it is one more
      } catch (const std::exception& error) {
        put(CameraLost{error.what()});
      }
      if (config_.is_recording) break;
      sleep(duration(config_.retry));
    }
    std::lock_guard lock(mutex_);
    call_since_.reset();
    has_left_ = true;
    changed_.notify_all();
  }

  void stop() {
    std::lock_guard lock(mutex_);
    is_stopped_ = true;
    changed_.notify_all();
  }
  bool wait_until_left() {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, duration(config_.leave), [this] { return has_left_; });
  }

  std::optional<CameraEvent> take(milliseconds patience) {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, patience, [this] { return !events_.empty(); })) {
      return std::nullopt;
    }
    CameraEvent event = std::move(events_.front());
    events_.pop_front();
    changed_.notify_all();
    return event;
  }

  CameraLosses losses() const {
    std::lock_guard lock(mutex_);
    return losses_;
  }
  std::int64_t dropped() const {
    std::lock_guard lock(mutex_);
    return dropped_;
  }
  double seconds_in_call() const {
    std::lock_guard lock(mutex_);
    if (!call_since_) return 0.0;
    return std::chrono::duration<double>(Clock::now() - *call_since_).count();
  }

 private:
  // Depth and colour are watched each: a camera with one of them is of no use.
  void serve(RgbdCamera& camera) {
    CameraLosses known;
    std::array<Clock::duration, 2> silence{};  // in the camera's calls, since the last one came
    while (!is_stopped() && !camera.has_ended()) {
      const Clock::time_point before = Clock::now();
      note_call();
      std::optional<CameraImage> image = camera.read(kPatience);
      const Clock::duration waited = Clock::now() - before;
      for (Clock::duration& kind : silence) kind += waited;
      const CameraLosses losses = camera.losses();
      note_losses(losses - std::exchange(known, losses));
      if (image) {
        silence.at(image->image.index()) = {};
        put(ImageArrived{std::move(*image), std::chrono::system_clock::now()});
      }
      if (const auto attitude = camera.attitude()) put(AttitudeMeasured{*attitude});
      check(silence, camera);
    }
    if (camera.has_ended()) put(RecordingEnded{});
  }

  void check(const std::array<Clock::duration, 2>& silence, const RgbdCamera& camera) {
    const auto longest = std::max_element(silence.begin(), silence.end());
    if (*longest <= duration(config_.timeout) || camera.has_ended()) return;
    note_call();  // it is closed now, which may hang too
    throw SourceError(fmt::format("{}: no whole {} image for {} s", camera.description().name,
                                  longest == silence.begin() ? "depth" : "colour",
                                  config_.timeout));
  }

  // Waits for room where every image counts. Only images give way to others.
  void put(CameraEvent event) {
    std::unique_lock lock(mutex_);
    call_since_.reset();
    if (config_.is_recording) {
      changed_.wait(lock, [this] { return is_stopped_ || events_.size() < config_.capacity; });
    } else if (events_.size() >= config_.capacity) {
      const auto oldest = std::find_if(events_.begin(), events_.end(), [](const CameraEvent& e) {
        return std::holds_alternative<ImageArrived>(e);
      });
      if (oldest != events_.end()) {
        events_.erase(oldest);
        ++dropped_;
      }
    }
    events_.push_back(std::move(event));
    changed_.notify_all();
  }

  void note_call() {
    std::lock_guard lock(mutex_);
    call_since_ = Clock::now();
  }
  void note_losses(const CameraLosses& more) {
    std::lock_guard lock(mutex_);
    losses_ = losses_ + more;
  }
  bool is_stopped() const {
    std::lock_guard lock(mutex_);
    return is_stopped_;
  }
  void sleep(Clock::duration time) {
    std::unique_lock lock(mutex_);
    call_since_.reset();
    changed_.wait_for(lock, time, [this] { return is_stopped_; });
  }

  Open open_;
  CameraThreadConfig config_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<CameraEvent> events_;
  CameraLosses losses_;
  std::int64_t dropped_ = 0;
  std::optional<Clock::time_point> call_since_;
  bool is_stopped_ = false, has_left_ = false;
};

CameraThread::CameraThread(Open open, const CameraThreadConfig& config)
    : state_(std::make_shared<State>(std::move(open), config)),
      thread_([state = state_] { state->run(); }) {}

CameraThread::~CameraThread() { close(); }

bool CameraThread::close() {
  if (!thread_.joinable()) return true;
  state_->stop();
  const bool has_left = state_->wait_until_left();
  if (has_left) {
    thread_.join();
  } else {
    thread_.detach();
  }
  return has_left;
}

std::optional<CameraEvent> CameraThread::take(milliseconds patience) {
  return state_->take(patience);
}
CameraLosses CameraThread::losses() const { return state_->losses(); }
std::int64_t CameraThread::dropped() const { return state_->dropped(); }
double CameraThread::seconds_in_call() const { return state_->seconds_in_call(); }

}  // namespace geomap::drivers
