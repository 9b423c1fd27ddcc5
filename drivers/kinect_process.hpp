// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "drivers/camera_file.hpp"
#include "drivers/camera_thread.hpp"
#include "drivers/frame_pairing.hpp"
#include "drivers/kinect_config.hpp"
#include "drivers/sensor_clock.hpp"
#include "messaging/live_process.hpp"

namespace geomap::drivers {

/// @brief What the images come from.
struct CameraSource {
  CameraThread::Open open;
  bool is_recording = false;       // ends
  bool is_recorded = false;        // into a file, which is only whole once the camera is closed
  bool keeps_sensor_time = false;  // as utime, so that a recording always gives the same
  CameraFile known;                // of the camera: intrinsics, depth correction
};

/// @brief A camera's images as RGBD_FRAME. It waits for a camera, opens it again when it is gone or
/// silent, and says so in HEALTH.
class KinectProcess {
 public:
  KinectProcess(const KinectConfig& config, CameraSource source, messaging::LiveProcess& live);

  /// @brief Closes the camera, after the last image that counts.
  /// @throws messaging::FatalFault when that leaves a recording unfinished.
  void finish();
  std::string summary() const;

 private:
  enum class State { kClosed, kOpen, kDelivers };

  /// @throws messaging::FatalFault when the camera's library hangs, or a recording cannot be
  /// played.
  void step();
  void take(ImageArrived arrived);
  void take(CameraOpened opened);
  void take(const AttitudeMeasured& measured);
  void take(const CameraLost& lost);
  void take(const RecordingEnded&);
  void note_first_frame();
  void publish(ImagePair pair);
  void note_counts();

  KinectConfig config_;
  CameraSource source_;
  messaging::LiveProcess& live_;
  std::optional<CameraThread> camera_;  // from the first step on
  CameraDescription description_;       // of the camera that is open, or was last
  State state_ = State::kClosed;
  std::string trouble_;  // last said
  FramePairing pairing_;
  SensorClock clock_;
  std::int64_t sequence_ = 0;
  std::int64_t last_utime_ = 0;  // of a frame [us]
};

}  // namespace geomap::drivers
