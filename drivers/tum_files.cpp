// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/tum_files.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <tuple>

#include "drivers/frame_source.hpp"

namespace geomap::drivers {
namespace {

using std::filesystem::path;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string where(const path& file, const TextRow& row) {
  return file.string() + ", line " + std::to_string(row.line) + ": ";
}

std::int64_t stamp_of(const TextRow& row, const path& file) {
  const std::optional<std::int64_t> utime = parse_seconds(row.words.front());
  if (!utime) throw SourceError(where(file, row) + "'" + row.words.front() + "' is no time stamp");
  return *utime;
}

// Of equal stamps the first stays: one moment, one image.
template <typename Stamped>
void order_by_time(std::vector<Stamped>& list) {
  std::stable_sort(list.begin(), list.end(),
                   [](const Stamped& a, const Stamped& b) { return a.utime < b.utime; });
  const auto same = [](const Stamped& a, const Stamped& b) { return a.utime == b.utime; };
  list.erase(std::unique(list.begin(), list.end(), same), list.end());
}

std::vector<std::int64_t> utimes_of(const std::vector<StampedFile>& list) {
  std::vector<std::int64_t> utimes;
  for (const StampedFile& file : list) utimes.push_back(file.utime);
  return utimes;
}

}  // namespace

std::optional<std::int64_t> parse_seconds(std::string_view text) {
  constexpr std::size_t kMaxWholeDigits = 12;  // 10^12 s fit into 63 bits of microseconds
  const std::size_t point = std::min(text.find('.'), text.size());
  const std::string_view whole = text.substr(0, point);
  const std::string_view decimals = point < text.size() ? text.substr(point + 1) : "";
  if (whole.empty() || whole.size() > kMaxWholeDigits ||
      !std::all_of(whole.begin(), whole.end(), is_digit) ||
      !std::all_of(decimals.begin(), decimals.end(), is_digit)) {
    return std::nullopt;
  }
  std::int64_t utime = 0;
  for (const char c : whole) utime = 10 * utime + (c - '0');
  for (std::size_t i = 0; i < 6; ++i) {
    utime = 10 * utime + (i < decimals.size() ? decimals[i] - '0' : 0);
  }
  if (decimals.size() > 6 && decimals[6] >= '5') ++utime;
  return utime;
}

std::vector<StampedFile> read_file_list(const path& file) {
  std::vector<StampedFile> list;
  for (const TextRow& row : read_rows(file)) {
    if (row.words.size() < 2) throw SourceError(where(file, row) + "no file name");
    list.push_back({stamp_of(row, file), row.words[1]});
  }
  order_by_time(list);
  return list;
}

StampedPose to_pose(const TextRow& row, const path& file) {
  if (row.words.size() != 8) {
    throw SourceError(where(file, row) + std::to_string(row.words.size()) +
                      " words where 8 are wanted: seconds tx ty tz qx qy qz qw");
  }
  double v[7];
  for (std::size_t i = 0; i < 7; ++i) v[i] = to_number(row.words[i + 1], file, row.line);
  const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
  // Trajectories are printed with 4 decimals: off by more it is something else than a quaternion.
  if (!(std::abs(q.norm() - 1.0) <= 1e-3)) {
    throw SourceError(where(file, row) +
                      "the quaternion does not have length 1; its order is qx qy qz qw");
  }
  StampedPose pose{stamp_of(row, file), Eigen::Isometry3d::Identity()};
  pose.T_world_camera.linear() = q.normalized().toRotationMatrix();
  pose.T_world_camera.translation() = Eigen::Vector3d(v[0], v[1], v[2]);
  return pose;
}

std::vector<StampedPose> read_trajectory(const path& file) {
  std::vector<StampedPose> trajectory;
  for (const TextRow& row : read_rows(file)) trajectory.push_back(to_pose(row, file));
  order_by_time(trajectory);
  return trajectory;
}

std::vector<std::pair<std::size_t, std::size_t>> associate(std::span<const std::int64_t> a,
                                                           std::span<const std::int64_t> b,
                                                           std::int64_t max_gap) {
  std::vector<std::tuple<std::int64_t, std::size_t, std::size_t>> candidates;  // gap, in a, in b
  std::size_t first = 0;  // of b within reach of a[i]; both lists are by time
  for (std::size_t i = 0; i < a.size(); ++i) {
    while (first < b.size() && b[first] < a[i] - max_gap) ++first;
    for (std::size_t k = first; k < b.size() && b[k] <= a[i] + max_gap; ++k) {
      candidates.emplace_back(std::abs(a[i] - b[k]), i, k);
    }
  }
  std::sort(candidates.begin(), candidates.end());

  std::vector<bool> used_a(a.size()), used_b(b.size());
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const auto& [gap, i, k] : candidates) {
    if (used_a[i] || used_b[k]) continue;
    used_a[i] = used_b[k] = true;
    pairs.emplace_back(i, k);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<std::pair<std::size_t, std::size_t>> associate(const std::vector<StampedFile>& a,
                                                           const std::vector<StampedFile>& b,
                                                           std::int64_t max_gap) {
  return associate(utimes_of(a), utimes_of(b), max_gap);
}

std::optional<Eigen::Isometry3d> pose_at(const std::vector<StampedPose>& trajectory,
                                         std::int64_t utime, std::int64_t max_gap) {
  const auto after =
      std::lower_bound(trajectory.begin(), trajectory.end(), utime,
                       [](const StampedPose& pose, std::int64_t t) { return pose.utime < t; });
  if (after == trajectory.end()) return std::nullopt;
  if (after->utime == utime) return after->T_world_camera;
  if (after == trajectory.begin()) return std::nullopt;
  const auto before = after - 1;
  const std::int64_t gap = after->utime - before->utime;
  if (gap > max_gap) return std::nullopt;

  const double s = static_cast<double>(utime - before->utime) / static_cast<double>(gap);
  const Eigen::Quaterniond q0(before->T_world_camera.linear());
  const Eigen::Quaterniond q1(after->T_world_camera.linear());
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  T_world_camera.linear() = q0.slerp(s, q1).normalized().toRotationMatrix();
  T_world_camera.translation() =
      (1.0 - s) * before->T_world_camera.translation() + s * after->T_world_camera.translation();
  return T_world_camera;
}

}  // namespace geomap::drivers
