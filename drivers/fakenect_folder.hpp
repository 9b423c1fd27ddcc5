// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "geometry/rgbd_frame.hpp"

namespace geomap::drivers {

/// @brief A folder as libfreenect's fakenect-record writes it, and fakenect plays it in place of a
/// Kinect: depth as 11-bit disparities with nominal constants, colour, and the accelerometer.
///
/// A Kinect has no other size than 640x480, and counts its images' time in 60 MHz ticks.
class FakenectFolder {
 public:
  /// @throws SourceError naming the folder when it cannot be made, or holds a recording.
  explicit FakenectFolder(const std::filesystem::path& folder);

  /// @param utime of the frame [us]. @param up unit vector, optical frame.
  /// @throws SourceError when a file cannot be written; std::invalid_argument for another size.
  void add(const geometry::RgbdFrame& frame, std::int64_t utime, const Eigen::Vector3d& up);

 private:
  void write(char kind, std::int64_t utime, const std::string& extension,
             const std::string& content);

  std::filesystem::path folder_;
  std::ofstream index_;
};

}  // namespace geomap::drivers
