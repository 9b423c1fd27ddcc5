// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/render_trajectory.hpp"

#include <imgui.h>

#include "viewer/line_list.hpp"

namespace geomap::viewer {
namespace {

constexpr Rgba kPathColor = {0.93F, 0.42F, 0.72F, 1.0F};

Eigen::Vector3d beginning_of(const TrackLayer& track) {
  if (!track.poses.empty()) return track.poses.front().T_world_camera.translation();
  if (!track.keyframes.empty()) return track.keyframes.begin()->second.translation();
  return Eigen::Vector3d::Zero();
}

}  // namespace

void RenderTrajectory::upload(const TrackLayer& track) {
  const Eigen::Vector3d origin = beginning_of(track);
  T_world_path_ = Eigen::Translation3d(origin);
  std::vector<Vertex> lines;
  for (std::size_t i = 1; i < track.poses.size(); ++i) {
    add_line(track.poses[i - 1].T_world_camera.translation() - origin,
             track.poses[i].T_world_camera.translation() - origin, kPathColor, lines);
  }
  std::vector<Vertex> dots;
  for (const auto& [id, T_world_camera] : track.keyframes) {
    dots.push_back({.position = (T_world_camera.translation() - origin).cast<float>(),
                    .color = bytes_of(kPathColor),
                    .along = 0.0F});
  }
  painter_->upload(path_, lines);
  painter_->upload(keyframes_, dots);
}

void RenderTrajectory::draw(const DrawContext& context) {
  const TrackLayer& track = context.scene.track;
  if (stamp_ != track.stamp) {
    upload(track);
    stamp_ = track.stamp;
  }
  // Dots first: the soft rim of a line would cut into what is drawn behind it later.
  if (shows_keyframes_) {
    painter_->points(context, keyframes_, keyframes_.size(), T_world_path_,
                     {.size = 7.0F, .is_round = true, .heights = {}, .hidden_above = {}});
  }
  painter_->lines(context, path_, T_world_path_, {.width = 2.0F});
}

bool RenderTrajectory::panel() { return ImGui::Checkbox("Key frames", &shows_keyframes_); }

void RenderTrajectory::load(const Preferences& preferences) {
  shows_keyframes_ = preferences.get(name() + ".keyframes", shows_keyframes_);
}

void RenderTrajectory::store(Preferences& preferences) const {
  preferences.set(name() + ".keyframes", shows_keyframes_);
}

}  // namespace geomap::viewer
