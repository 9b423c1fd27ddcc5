// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

namespace geomap::logs {

/// @brief When [us] and where: T_world_camera, by time.
using Trajectory = std::vector<std::pair<std::int64_t, Eigen::Isometry3d>>;

/// @brief Writes poses T_world_camera in the format of the TUM RGB-D benchmark, one a line:
/// `seconds tx ty tz qx qy qz qw`, seconds = utime / 10⁶ to the microsecond.
/// @throws std::runtime_error when the file cannot be written.
void write_trajectory(const std::filesystem::path& path, const Trajectory& poses);

/// @brief Reads the same format: blank lines and lines from `#` on are skipped, seconds become
/// utime digit by digit, quaternions are normalised.
/// @throws std::runtime_error, one line that names the file, the line in it and the remedy, for a
/// missing or empty file, a line that is no pose, or times that do not ascend.
Trajectory read_trajectory(const std::filesystem::path& path);

}  // namespace geomap::logs
