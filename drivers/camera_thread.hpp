// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <variant>

#include "drivers/rgbd_camera.hpp"

namespace geomap::drivers {

struct CameraThreadConfig {
  double timeout = 1.0;  // without an image of either kind, after which the camera is closed [s]
  double retry = 0.5;    // between two tries to open it [s]
  bool is_recording = false;  // ends; is not opened again; every image counts
  std::size_t capacity = 32;  // images that wait
  double leave = 3.0;         // for the camera to close at the end [s]
};

/// @brief An image, and when it came.
struct ImageArrived {
  CameraImage image;
  std::chrono::system_clock::time_point arrival;
};
struct CameraOpened {
  CameraDescription description;
};
struct AttitudeMeasured {
  CameraAttitude attitude;
};
struct CameraLost {
  std::string reason;
};
struct RecordingEnded {};
using CameraEvent =
    std::variant<ImageArrived, CameraOpened, AttitudeMeasured, CameraLost, RecordingEnded>;

/// @brief A camera in a thread of its own, which opens it, reads it, and opens it again when it is
/// gone or silent. So whoever takes the images may be late now and then, and can tell when a call
/// in the camera's library does not return.
class CameraThread {
 public:
  /// @brief Opens the camera; called in the thread. @throws SourceError when that cannot be.
  using Open = std::function<std::unique_ptr<RgbdCamera>()>;

  CameraThread(Open open, const CameraThreadConfig& config);
  /// @brief As close().
  ~CameraThread();
  CameraThread(const CameraThread&) = delete;
  CameraThread& operator=(const CameraThread&) = delete;

  /// @brief Closes the camera. A thread that its library keeps for longer than `leave` is left
  /// behind. @return false then.
  bool close();

  /// @brief What happened next, or nothing within `patience`. Of a recording no image is lost; of a
  /// camera the oldest are when too many wait.
  std::optional<CameraEvent> take(std::chrono::milliseconds patience);

  CameraLosses losses() const;   // of all cameras so far
  std::int64_t dropped() const;  // images that waited too long

  /// @brief How long the present call in the camera's library has taken [s].
  double seconds_in_call() const;

 private:
  class State;
  std::shared_ptr<State> state_;
  std::thread thread_;
};

}  // namespace geomap::drivers
