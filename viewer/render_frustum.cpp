// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/render_frustum.hpp"

#include "geometry/frustum.hpp"
#include "viewer/line_list.hpp"
#include "viewer/setting_widgets.hpp"

namespace geomap::viewer {
namespace {

constexpr double kNear = 0.4;  // depth from which on the camera measures [m]
constexpr Rgba kWhite = {1.0F, 1.0F, 1.0F, 1.0F};
constexpr Rgba kFaint = {1.0F, 1.0F, 1.0F, 0.45F};

std::vector<Vertex> frustum_lines(const geometry::CameraModel& camera, double far) {
  const geometry::Frustum frustum(camera, kNear, far, Eigen::Isometry3d::Identity());
  const auto& corners = frustum.corners();
  std::vector<Vertex> lines;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    add_line(Eigen::Vector3d::Zero(), corners[i], kWhite, lines);
    add_line(corners[i], corners[next], kWhite, lines);
    add_line(corners[i], corners[4 + i], kFaint, lines);
    add_line(corners[4 + i], corners[4 + next], kFaint, lines);
  }
  // A triangle above the image tells which way is up.
  const Eigen::Vector3d middle = 0.5 * (corners[0] + corners[1]);
  const Eigen::Vector3d tip = middle + 0.35 * (corners[0] - corners[3]);
  add_line(corners[0], tip, kWhite, lines);
  add_line(tip, corners[1], kWhite, lines);
  return lines;
}

}  // namespace

void RenderFrustum::draw(const DrawContext& context) {
  const TrackLayer& track = context.scene.track;
  if (!track.newest || !track.camera || !track.camera->valid()) return;
  if (uploaded_ != track.camera || uploaded_far_ != far_) {
    painter_->upload(lines_, frustum_lines(*track.camera, far_));
    uploaded_ = track.camera;
    uploaded_far_ = far_;
  }
  painter_->lines(context, lines_, track.newest->T_world_camera,
                  {.tint = context.theme.foreground, .width = 1.5F});
}

bool RenderFrustum::panel() { return slider("Depth", far_, 0.5, 8.0, "%.1f m"); }

void RenderFrustum::load(const Preferences& preferences) {
  far_ = std::clamp(preferences.get(name() + ".depth", far_), 0.5, 8.0);
}

void RenderFrustum::store(Preferences& preferences) const {
  preferences.set(name() + ".depth", far_);
}

}  // namespace geomap::viewer
