// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OpenNI.h>

#include <initializer_list>
#include <optional>
#include <string>

#include "drivers/rgbd_camera.hpp"

namespace geomap::drivers {

/// @throws SourceError "ACTION: reason", in OpenNI2's words, unless all is well.
void check_openni(openni::Status status, const std::string& action);

/// @brief OpenNI2 itself. Started anew with each camera, so that its drivers look for devices
/// again.
class OpenNi2Library {
 public:
  OpenNi2Library();
  ~OpenNi2Library();
  OpenNi2Library(const OpenNi2Library&) = delete;
  OpenNi2Library& operator=(const OpenNi2Library&) = delete;
};

/// @brief One of a device's streams: its images in our types, and what of them is lost.
class OpenNi2Stream {
 public:
  /// @param type SENSOR_DEPTH or SENSOR_COLOR.
  /// @throws SourceError when the device has no such stream.
  OpenNi2Stream(const openni::Device& device, openni::SensorType type);

  openni::VideoStream& handle() { return stream_; }
  /// @brief The camera of its images, from the field of view.
  geometry::CameraModel camera() const;
  void start();
  void stop() { stream_.stop(); }

  /// @brief Reads the image that is there, or waits for one. @return nothing for half an image.
  std::optional<CameraImage> read();

  int last_number() const { return last_number_; }  // of an image, from 1 on; 0 before the first
  std::int64_t last_time() const { return last_time_; }  // sensor's clock [us]
  const CameraLosses& losses() const { return losses_; }

 private:
  openni::SensorType type_;
  openni::VideoStream stream_;
  int last_number_ = 0;
  std::int64_t last_time_ = -1;
  CameraLosses losses_;
};

/// @brief The stream with the oldest image; null when none comes within `milliseconds`.
OpenNi2Stream* wait_for_openni(std::initializer_list<OpenNi2Stream*> streams, int milliseconds);

/// @brief What frames of the two streams look like.
/// @param is_registered depth is in the colour camera's view.
/// @throws SourceError when the device does not say its field of view.
CameraDescription describe_openni(const openni::Device& device, const OpenNi2Stream& depth,
                                  const OpenNi2Stream& color, bool is_registered);

}  // namespace geomap::drivers
