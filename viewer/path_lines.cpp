// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/path_lines.hpp"

#include "viewer/line_list.hpp"

namespace geomap::viewer {
namespace {

bool is_same(const TrackLayer::Pose& a, const TrackLayer::Pose& b) {
  return a.utime == b.utime && a.T_world_camera.matrix() == b.T_world_camera.matrix();
}

}  // namespace

std::size_t PathLines::follow(const std::vector<TrackLayer::Pose>& poses) {
  std::size_t unchanged = lines_.size();
  if (!begins_with_taken(poses)) {
    begin_anew(0.0);
    unchanged = 0;
  }
  take(poses);
  while (lines_.size() > 2 * kMostPieces) {
    // No piece is shorter than the step: half as many as there may be remain, or fewer.
    begin_anew(2.0 * length_ / static_cast<double>(kMostPieces));
    take(poses);
    unchanged = 0;
  }
  return unchanged;
}

bool PathLines::begins_with_taken(const std::vector<TrackLayer::Pose>& poses) const {
  return taken_ == 0 || (taken_ <= poses.size() && is_same(poses.front(), first_) &&
                         is_same(poses[taken_ - 1], last_));
}

void PathLines::begin_anew(double step) {
  lines_.clear();
  has_origin_ = false;
  taken_ = 0;
  length_ = 0.0;
  step_ = step;
}

void PathLines::take(const std::vector<TrackLayer::Pose>& poses) {
  for (std::size_t i = taken_; i < poses.size(); ++i) {
    const Eigen::Vector3d position = poses[i].T_world_camera.translation();
    if (!position.allFinite()) continue;
    if (!has_origin_) {
      origin_ = end_ = position;
      has_origin_ = true;
      continue;
    }
    const double distance = (position - end_).norm();
    if (distance < step_) continue;
    add_line(end_ - origin_, position - origin_, kPathColor, lines_);
    length_ += distance;
    end_ = position;
  }
  taken_ = poses.size();
  if (taken_ == 0) return;
  first_ = poses.front();
  last_ = poses.back();
}

}  // namespace geomap::viewer
