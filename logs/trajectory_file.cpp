// SPDX-License-Identifier: BSD-3-Clause
#include "logs/trajectory_file.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

#include "drivers/tum_files.hpp"
#include "mapping/export_file.hpp"

namespace geomap::logs {
namespace {

constexpr double kFarthest = 1e9;  // [m]; more is a column out of place, such as a time

}  // namespace

void write_trajectory(const std::filesystem::path& path, const Trajectory& poses) {
  std::string text = "# seconds tx ty tz qx qy qz qw of T_world_camera\n";
  for (const auto& [utime, T] : poses) {
    const Eigen::Quaterniond q(T.linear());
    const Eigen::Vector3d t = T.translation();
    text += fmt::format("{}.{:06} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f}\n",
                        utime / 1'000'000, utime % 1'000'000, t.x(), t.y(), t.z(), q.x(), q.y(),
                        q.z(), q.w());
  }
  mapping::write_file(path, text);
}

Trajectory read_trajectory(const std::filesystem::path& path) {
  Trajectory trajectory;
  for (const drivers::TextRow& row : drivers::read_rows(path)) {
    const drivers::StampedPose pose = drivers::to_pose(row, path);
    const auto refuse = [&](const std::string& why) {
      throw std::runtime_error(fmt::format("{}, line {}: {}", path.string(), row.line, why));
    };
    if (pose.T_world_camera.translation().cwiseAbs().maxCoeff() > kFarthest) {
      refuse("the position is more than 10^9 m away; the columns are seconds tx ty tz qx qy qz qw");
    }
    if (!trajectory.empty() && pose.utime <= trajectory.back().first) {
      refuse(row.words.front() +
             " s does not come after the pose before; sort the lines by time and keep one of each "
             "time");
    }
    trajectory.emplace_back(pose.utime, pose.T_world_camera);
  }
  if (trajectory.empty()) {
    throw std::runtime_error(path.string() +
                             ": no pose in it; each line must be seconds tx ty tz qx qy qz qw");
  }
  return trajectory;
}

}  // namespace geomap::logs
