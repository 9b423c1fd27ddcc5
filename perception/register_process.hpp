// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "geomap/map_edit_reply_t.hpp"
#include "geomap/map_request_t.hpp"
#include "messaging/camera_config.hpp"
#include "messaging/config.hpp"
#include "messaging/live_process.hpp"
#include "perception/keyframe_journal.hpp"
#include "perception/keyframe_messages.hpp"
#include "perception/sensor_messages.hpp"
#include "perception/tracking_process.hpp"

namespace geomap::perception {

struct RegisterConfig {
  std::string state_folder;  // for going on after a restart; empty: nothing is kept
  TrackerConfig tracker;
  messaging::FrameCameras cameras;  // of OPENNI_FRAME and KINECT_FRAME
};

/// @brief All but the state folder. @throws messaging::ConfigError.
RegisterConfig read_register_config(const messaging::Config& config);

/// @brief geomap-register: sensors and robot in, key frames with their poses out. Owns every key
/// frame's pose; what is dropped or moved is told on KEYFRAME_UPDATE.
class RegisterProcess {
 public:
  RegisterProcess(const RegisterConfig& config, messaging::LiveProcess& live);

  /// @brief Tracks what still waits for a prior. Call after the last message.
  void finish();
  std::string summary() const;

 private:
  void take_sensor(const std::string& channel, messaging::LiveProcess::Bytes data);
  void take_request(const geomap::map_request_t& request);
  void take_reply(const geomap::map_edit_reply_t& reply);
  void take_tracked(const TrackedFrame& frame);
  void restore(const std::string& folder);
  template <typename Write>
  void keep(const Write& write);
  void publish_points(bool complete);
  void note_counts();

  messaging::LiveProcess& live_;
  TrackingProcess tracking_;
  SensorMessages sensors_;
  TrackingMessages messages_;
  std::optional<KeyframeJournal> journal_;
  std::int64_t noted_missing_ = 0;
  std::int64_t newest_utime_ = 0;  // of a frame [us]
  std::int64_t epoch_ = 0;         // of KEYFRAME_UPDATE
  std::int64_t points_sequence_ = 0;
};

}  // namespace geomap::perception
