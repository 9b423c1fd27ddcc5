// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/render_trajectory.hpp"

#include <imgui.h>

#include <utility>

#include "viewer/line_list.hpp"

namespace geomap::viewer {
namespace {

constexpr std::size_t kMostDots = 20'000;

std::vector<Vertex> dots_of(const TrackLayer& track, const Eigen::Vector3d& origin) {
  const std::size_t every = 1 + track.keyframes.size() / kMostDots;
  std::vector<Vertex> dots;
  std::size_t number = 0;
  for (const auto& [id, T_world_camera] : track.keyframes) {
    if (number++ % every != 0) continue;
    dots.push_back({.position = (T_world_camera.translation() - origin).cast<float>(),
                    .color = bytes_of(kPathColor)});
  }
  return dots;
}

}  // namespace

void RenderTrajectory::update(const TrackLayer& track) {
  const std::size_t unchanged = path_.follow(track.poses);
  if (unchanged < path_.lines().size() || path_.lines().size() < path_buffer_.size()) {
    painter_->extend(path_buffer_, path_.lines(), unchanged);
  }
  T_world_path_ = Eigen::Translation3d(path_.origin());
  // Poses come often and key frames seldom; corrections change their places.
  std::vector<Vertex> dots = dots_of(track, path_.origin());
  if (dots == dots_) return;
  dots_ = std::move(dots);
  painter_->upload(keyframes_, dots_);
}

void RenderTrajectory::draw(const DrawContext& context) {
  const TrackLayer& track = context.scene.track;
  if (stamp_ != track.stamp) {
    update(track);
    stamp_ = track.stamp;
  }
  // Dots first: the soft rim of a line would cut into what is drawn behind it later.
  if (shows_keyframes_) {
    painter_->points(context, keyframes_, keyframes_.size(), T_world_path_,
                     {.size = 7.0F, .is_round = true});
  }
  painter_->lines(context, path_buffer_, T_world_path_, {.width = 2.0F});
}

bool RenderTrajectory::panel() { return ImGui::Checkbox("Key frames", &shows_keyframes_); }

void RenderTrajectory::load(const Preferences& preferences) {
  shows_keyframes_ = preferences.get(name() + ".keyframes", shows_keyframes_);
}

void RenderTrajectory::store(Preferences& preferences) const {
  preferences.set(name() + ".keyframes", shows_keyframes_);
}

}  // namespace geomap::viewer
