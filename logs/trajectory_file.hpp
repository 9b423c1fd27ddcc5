// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

namespace geomap::logs {

/// @brief Writes poses T_world_camera in the format of the TUM RGB-D benchmark, one a line:
/// `seconds tx ty tz qx qy qz qw`, seconds = utime / 10⁶ to the microsecond.
/// @throws std::runtime_error when the file cannot be written.
void write_trajectory(const std::filesystem::path& path,
                      const std::vector<std::pair<std::int64_t, Eigen::Isometry3d>>& poses);

}  // namespace geomap::logs
