// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "geometry/camera_model.hpp"
#include "geometry/rgbd_frame.hpp"

namespace geomap::drivers {

/// @brief One image as a camera delivers it: depth and colour come one by one.
struct CameraImage {
  std::int64_t sensor_time = 0;  // sensor's clock [us]
  std::variant<geometry::DepthImage, geometry::ColorImage> image;
};

/// @brief What RGBD_FRAME shall say of a camera's images.
struct CameraDescription {
  std::string name;  // for people, with the device's address
  geometry::CameraModel depth;
  geometry::CameraModel color;
  bool is_registered = false;  // depth is in the colour camera's view
};

/// @brief How a camera is held.
struct CameraAttitude {
  /// That the camera feels, in its optical frame (x right, y down, z forward) [m/s²]: at rest it
  /// points upwards, and is 9.8 long.
  Eigen::Vector3d acceleration;
  double tilt = 0.0;  // of the motor that holds it, upwards [rad]
};

/// @brief Images that did not reach us.
struct CameraLosses {
  std::int64_t torn = 0;    // refused: less data than their size needs
  std::int64_t missed = 0;  // numbers that were skipped, where the camera numbers its images

  CameraLosses operator+(const CameraLosses& other) const {
    return {torn + other.torn, missed + other.missed};
  }
  CameraLosses operator-(const CameraLosses& other) const {
    return {torn - other.torn, missed - other.missed};
  }
};

/// @brief A camera that is open; it is closed with this object.
class RgbdCamera {
 public:
  virtual ~RgbdCamera() = default;

  virtual const CameraDescription& description() const = 0;

  /// @brief The next image; nothing when none comes within `patience`, or at the end.
  /// @throws SourceError, which says why, when the camera is gone.
  virtual std::optional<CameraImage> read(std::chrono::milliseconds patience) = 0;

  /// @brief Where the camera can tell and it is time to ask again, about once a second.
  virtual std::optional<CameraAttitude> attitude() { return std::nullopt; }

  /// @brief True after the last image of a recording.
  virtual bool has_ended() const { return false; }

  /// @brief Since it is open.
  virtual CameraLosses losses() const = 0;
};

}  // namespace geomap::drivers
