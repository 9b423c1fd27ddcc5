// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "drivers/camera_trajectory.hpp"

namespace geomap::drivers {

/// @brief A robot's way as people write it, config/trajectories/NAME.yaml:
///
///     name: sweep           # default: the file's name
///     camera_height: 1.2    # [m]
///     camera_forward: 0.1   # [m]
///     waypoints:            # t [s] rises; what is not given stays as it was, at first 0
///       - {t: 0, x: -1.8, y: 1.6, yaw_deg: 0, pan_deg: 0, tilt_deg: 20}
///       - {t: 4, y: 0.4}
///
/// The result always makes a CameraTrajectory.
/// @throws SourceError "FILE:LINE: what" when the file cannot be read, is not YAML, or has a key or
/// a value that makes no sense.
RobotTrajectory read_robot_trajectory(const std::filesystem::path& path);

}  // namespace geomap::drivers
