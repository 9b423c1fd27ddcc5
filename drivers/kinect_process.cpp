// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/kinect_process.hpp"

#include <fmt/format.h>

#include <thread>
#include <utility>

#include "drivers/frame_source.hpp"
#include "messaging/channels.hpp"
#include "messaging/convert_frame.hpp"
#include "messaging/host_clock.hpp"
#include "messaging/log.hpp"

namespace geomap::drivers {
namespace {

constexpr std::chrono::milliseconds kPatience{50};  // between two looks at the bus
constexpr std::chrono::milliseconds kRetry{500};

}  // namespace

KinectProcess::KinectProcess(const KinectConfig& config, bool is_recorded, Open open,
                             messaging::LiveProcess& live)
    : config_(config),
      is_recorded_(is_recorded),
      open_(std::move(open)),
      live_(live),
      next_try_(Clock::now()),
      pairing_(config.pairing_tolerance()) {
  live_.every(0.0, [this] { step(); });
}

std::string KinectProcess::summary() const { return fmt::format("frames {}\n", sequence_); }

void KinectProcess::step() {
  if (camera_) {
    read();
  } else if (Clock::now() >= next_try_) {
    try_open();
  } else {
    std::this_thread::sleep_for(kPatience);
  }
}

void KinectProcess::try_open() {
  try {
    camera_ = open_();
  } catch (const SourceError& error) {
    lose(error.what());
    return;
  }
  last_image_ = Clock::now();
  is_silent_ = true;
  live_.health().count("camera.opened");
}

void KinectProcess::read() {
  try {
    if (auto image = camera_->read(kPatience)) {
      last_image_ = Clock::now();
      if (auto pair = pairing_.add(std::move(*image))) publish(std::move(*pair));
    }
  } catch (const SourceError& error) {
    lose(error.what());
    return;
  }
  live_.health().set("images.torn", torn_ + camera_->torn());
  live_.health().set("images.unpaired", pairing_.unpaired());
  live_.health().set("clock.restarts", clock_.restarts());
  if (camera_->has_ended()) {
    messaging::request_stop();
  } else if (Clock::now() - last_image_ > std::chrono::duration<double>(config_.timeout)) {
    lose(fmt::format("{}: no whole image for {} s", camera_->description().name, config_.timeout));
  }
}

// Said once for each reason, however often it is tried.
void KinectProcess::lose(const std::string& reason) {
  if (camera_) {
    torn_ += camera_->torn();
    live_.health().count("camera.lost");
    camera_.reset();
  }
  next_try_ = Clock::now() + kRetry;
  live_.health().set_trouble(geomap::health_t::FAILING, reason);
  if (reason == trouble_) return;
  trouble_ = reason;
  messaging::log_error(reason + "; trying again until it is there");
}

// To be open is not enough: a camera that hangs can be opened again and again.
void KinectProcess::note_first_frame() {
  is_silent_ = false;
  trouble_.clear();
  live_.health().set_trouble(geomap::health_t::GOOD, "");
  messaging::log_info("frames of " + camera_->description().name);
}

void KinectProcess::publish(ImagePair pair) {
  if (is_silent_) note_first_frame();
  geometry::RgbdFrame frame;
  frame.utime = is_recorded_ ? pair.sensor_time
                             : clock_.to_host(pair.sensor_time, messaging::host_microseconds());
  frame.sequence = sequence_++;
  frame.sensor = "kinect";
  frame.depth = std::move(pair.depth);
  frame.color = std::move(pair.color);
  frame.depth_camera = camera_->description().depth;
  frame.color_camera = camera_->description().color;
  live_.health().note_utime(frame.utime);
  live_.publish(messaging::channels::kRgbdFrame,
                messaging::to_message(frame, {}, config_.jpeg_quality));
}

}  // namespace geomap::drivers
