// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/kinect_process.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "geomap/camera_attitude_t.hpp"
#include "messaging/channels.hpp"
#include "messaging/convert_frame.hpp"
#include "messaging/log.hpp"
#include "messaging/stopwatch.hpp"

namespace geomap::drivers {
namespace {

constexpr std::chrono::milliseconds kLookInterval{50};  // between two looks at the bus
// Firmware is loaded within; whoever supervises the process starts it again [s].
constexpr double kLongestCall = 15.0;
// Images that wait to be written are written first, which takes a busy machine a while [s].
constexpr double kFinishRecording = 60.0;

CameraThreadConfig thread_config(const KinectConfig& config, const CameraSource& source) {
  CameraThreadConfig result;
  result.timeout = config.timeout;
  result.is_recording = source.is_recording;
  if (source.is_recorded) result.leave = kFinishRecording;
  return result;
}

void use_if_known(const std::optional<geometry::CameraModel>& known,
                  geometry::CameraModel& camera) {
  if (!known) return;
  if (known->width != camera.width || known->height != camera.height) {
    throw messaging::FatalFault(
        fmt::format("the camera file is for {}x{}, the camera has {}x{}: change kinect.width and "
                    "height, or the "
                    "file",
                    known->width, known->height, camera.width, camera.height));
  }
  camera = *known;
}

}  // namespace

KinectProcess::KinectProcess(const KinectConfig& config, CameraSource source,
                             messaging::LiveProcess& live)
    : config_(config),
      source_(std::move(source)),
      live_(live),
      pairing_(config.pairing_tolerance()) {
  live_.every(0.0, [this] { step(); });
}

void KinectProcess::finish() {
  const bool is_closed = !camera_ || camera_->close();
  if (is_closed || !source_.is_recorded) return;
  throw messaging::FatalFault(fmt::format(
      "the recording is cut off: it could not be finished within {:.0f} s", kFinishRecording));
}

std::string KinectProcess::summary() const { return fmt::format("frames {}\n", sequence_); }

// The camera is not touched before another copy of the process has had time to object.
void KinectProcess::step() {
  if (!camera_) camera_.emplace(source_.open, thread_config(config_, source_));
  if (camera_->seconds_in_call() > kLongestCall) {
    throw messaging::FatalFault(fmt::format(
        "the camera's library has not returned for {:.0f} s; the camera may need to be plugged in "
        "anew",
        kLongestCall));
  }
  if (auto event = camera_->take(kLookInterval)) {
    std::visit([this](auto&& happened) { take(std::forward<decltype(happened)>(happened)); },
               std::move(*event));
  }
  note_counts();
}

void KinectProcess::take(ImageArrived arrived) {
  const auto arrival =
      std::chrono::duration_cast<std::chrono::microseconds>(arrived.arrival.time_since_epoch());
  auto pair = pairing_.add(std::move(arrived.image), arrival.count());
  if (pair) publish(std::move(*pair));
}

void KinectProcess::take(CameraOpened opened) {
  description_ = std::move(opened.description);
  // What a calibration says counts more than what a camera says of itself.
  use_if_known(source_.known.color, description_.color);
  use_if_known(description_.is_registered ? source_.known.color : source_.known.depth,
               description_.depth);
  state_ = State::kOpen;
  pairing_.clear();
  live_.health().count("camera.opened");
}

void KinectProcess::take(const AttitudeMeasured& measured) {
  geomap::camera_attitude_t message;
  message.utime = last_utime_;
  std::copy_n(measured.attitude.acceleration.data(), 3, message.acceleration);
  message.tilt = measured.attitude.tilt;
  live_.publish(messaging::channels::kCameraAttitude, message);
}

// Said once for each reason, however often it is tried.
void KinectProcess::take(const CameraLost& lost) {
  if (source_.is_recording) throw messaging::FatalFault(lost.reason);
  if (state_ != State::kClosed) live_.health().count("camera.lost");
  state_ = State::kClosed;
  live_.health().set_trouble(geomap::health_t::FAILING, lost.reason);
  if (lost.reason == trouble_) return;
  trouble_ = lost.reason;
  messaging::log_error(lost.reason + "; trying again until it is there");
}

void KinectProcess::take(const RecordingEnded&) { messaging::request_stop(); }

// To be open is not enough: a camera that hangs can be opened again and again.
void KinectProcess::note_first_frame() {
  state_ = State::kDelivers;
  trouble_.clear();
  live_.health().set_trouble(geomap::health_t::GOOD, "");
  messaging::log_info("frames of " + description_.name);
}

void KinectProcess::publish(ImagePair pair) {
  if (state_ != State::kDelivers) note_first_frame();
  geometry::RgbdFrame frame;
  frame.utime =
      source_.keeps_sensor_time ? pair.sensor_time : clock_.to_host(pair.sensor_time, pair.arrival);
  frame.sequence = sequence_++;
  frame.sensor = "kinect";
  frame.depth = std::move(pair.depth);
  frame.color = std::move(pair.color);
  frame.depth_camera = description_.depth;
  frame.color_camera = description_.color;
  if (!source_.known.correction.is_none()) {
    frame = geometry::corrected(frame, source_.known.correction);
  }
  const messaging::Stopwatch compressing;
  const auto message = messaging::to_message(frame, {}, config_.jpeg_quality);
  live_.health().time("compression", compressing.seconds());
  live_.health().note_utime(frame.utime);
  last_utime_ = frame.utime;
  live_.publish(messaging::channels::kRgbdFrame, message);
}

void KinectProcess::note_counts() {
  const CameraLosses losses = camera_->losses();
  live_.health().set("images.torn", losses.torn);
  live_.health().set("images.missed", losses.missed);
  live_.health().set("images.dropped", camera_->dropped());
  live_.health().set("images.unpaired", pairing_.unpaired());
  live_.health().set("clock.restarts", clock_.restarts());
}

}  // namespace geomap::drivers
