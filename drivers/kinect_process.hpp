// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "drivers/frame_pairing.hpp"
#include "drivers/kinect_config.hpp"
#include "drivers/rgbd_camera.hpp"
#include "drivers/sensor_clock.hpp"
#include "messaging/live_process.hpp"

namespace geomap::drivers {

/// @brief A camera's images as RGBD_FRAME. It waits for a camera, opens it again when it is gone or
/// silent, and says so in HEALTH.
class KinectProcess {
 public:
  /// @brief Opens the camera. @throws SourceError when that cannot be.
  using Open = std::function<std::unique_ptr<RgbdCamera>()>;

  /// @param is_recorded utime is the sensor's time, so that a recording always gives the same.
  KinectProcess(const KinectConfig& config, bool is_recorded, Open open,
                messaging::LiveProcess& live);

  std::string summary() const;

 private:
  using Clock = std::chrono::steady_clock;

  void step();
  void try_open();
  void read();
  void lose(const std::string& reason);
  void note_first_frame();
  void publish(ImagePair pair);

  KinectConfig config_;
  bool is_recorded_;
  Open open_;
  messaging::LiveProcess& live_;
  std::unique_ptr<RgbdCamera> camera_;
  Clock::time_point next_try_, last_image_;
  bool is_silent_ = true;  // since it is open
  std::string trouble_;    // last said
  FramePairing pairing_;
  SensorClock clock_;
  std::int64_t sequence_ = 0;
  std::int64_t torn_ = 0;  // of cameras that are closed
};

}  // namespace geomap::drivers
