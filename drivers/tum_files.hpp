// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drivers/input_file.hpp"

namespace geomap::drivers {

/// @brief One line of depth.txt or rgb.txt: when, and the image file's name within the folder.
struct StampedFile {
  std::int64_t utime = 0;  // [us]
  std::string name;
};

/// @brief One line of groundtruth.txt.
struct StampedPose {
  std::int64_t utime = 0;  // [us]
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
};

/// @brief Seconds as text ("1305031102.160407") in microseconds, digit by digit: a double would
/// lose the last one. A seventh and further decimals are rounded. Nothing when it is no such
/// number.
std::optional<std::int64_t> parse_seconds(std::string_view text);

/// @brief depth.txt or rgb.txt of a TUM RGB-D folder, by time; of equal stamps the first stays.
/// @throws SourceError naming file and line.
std::vector<StampedFile> read_file_list(const std::filesystem::path& path);

/// @brief One line `seconds tx ty tz qx qy qz qw` of a trajectory; the quaternion is normalised.
/// @throws SourceError naming file and line.
StampedPose to_pose(const TextRow& row, const std::filesystem::path& path);

/// @brief A trajectory `seconds tx ty tz qx qy qz qw`, by time, quaternions normalised;
/// of equal stamps the first stays.
/// @throws SourceError naming file and line.
std::vector<StampedPose> read_trajectory(const std::filesystem::path& path);

/// @brief Pairs (index in a, index in b) of nearest stamps, at most `max_gap` [us] apart, each used
/// once: the closest pair first, as the data set's own associate.py does. By index in a.
/// @param a, b ascending [us].
std::vector<std::pair<std::size_t, std::size_t>> associate(std::span<const std::int64_t> a,
                                                           std::span<const std::int64_t> b,
                                                           std::int64_t max_gap);
std::vector<std::pair<std::size_t, std::size_t>> associate(const std::vector<StampedFile>& a,
                                                           const std::vector<StampedFile>& b,
                                                           std::int64_t max_gap);

/// @brief The pose at `utime`: a straight line and a great arc between the poses before and after
/// it. Nothing outside the trajectory, or between two poses more than `max_gap` [us] apart.
/// @param trajectory by time.
std::optional<Eigen::Isometry3d> pose_at(const std::vector<StampedPose>& trajectory,
                                         std::int64_t utime, std::int64_t max_gap);

}  // namespace geomap::drivers
