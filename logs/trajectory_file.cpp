// SPDX-License-Identifier: BSD-3-Clause
#include "logs/trajectory_file.hpp"

#include <fmt/format.h>

#include <string>

#include "mapping/export_file.hpp"

namespace geomap::logs {

void write_trajectory(const std::filesystem::path& path,
                      const std::vector<std::pair<std::int64_t, Eigen::Isometry3d>>& poses) {
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

}  // namespace geomap::logs
