// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "geometry/rgbd_frame.hpp"

namespace geomap::drivers {

/// @brief What is wrong with a data set or a camera, in one line that names the file or the device.
class SourceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// @brief One frame as a source delivers it.
struct SourceFrame {
  geometry::RgbdFrame frame;
  /// The file's own bytes where the colour image is a JPEG already; frame.color is empty then, and
  /// frame.color_camera has the image's size. Nothing is lost by coding it twice.
  std::vector<std::uint8_t> jpeg;
  std::optional<Eigen::Isometry3d> truth_T_world_camera;
  std::optional<Eigen::Isometry3d> T_body_camera;  // of a neck; none: forward_camera_mount()
  std::string origin;                              // file or device, for messages to people
};

/// @brief Frames of a data set that are wanted, both ends included. What is counted is the source's
/// matter: file numbers (7-Scenes) or the position in the sequence (TUM).
struct FrameRange {
  std::int64_t from = 0;
  std::int64_t to = std::numeric_limits<std::int64_t>::max();

  bool contains(std::int64_t number) const { return from <= number && number <= to; }
};

/// @brief Where RGB-D frames come from: a camera, a simulator or a folder, in the order of their
/// utime.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// @brief The next frame; nothing at the end. Frames are numbered from 0 in the order delivered.
  /// @throws SourceError when the frame is missing a file or one of its files cannot be used. The
  /// source has moved past that frame: calling again goes on with the one after it.
  virtual std::optional<SourceFrame> next() = 0;

  /// @brief How many calls of next() give a frame or throw; 0 where nobody knows (a live camera).
  virtual std::size_t size() const = 0;

  /// @brief True when at least one frame comes with its true pose.
  virtual bool has_truth() const = 0;

  /// @brief What the user should know about frames that are not delivered; empty: nothing.
  virtual std::string remark() const { return {}; }
};

}  // namespace geomap::drivers
