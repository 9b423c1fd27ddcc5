// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene_model.hpp"

#include <cmath>

namespace geomap::viewer {
namespace {

constexpr double kCameraHeight = 1.0;  // taken where the robot does not tell [m]

}  // namespace

std::optional<Eigen::Isometry3d> SceneModel::T_world_body() const {
  if (!track.newest) return std::nullopt;
  const Eigen::Isometry3d& T_world_camera = track.newest->T_world_camera;
  if (track.T_body_camera) return T_world_camera * track.T_body_camera->inverse();
  const Eigen::Vector3d forward = T_world_camera.linear().col(2);
  Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
  T_world_body.translation() =
      T_world_camera.translation() - kCameraHeight * Eigen::Vector3d::UnitZ();
  T_world_body.linear() =
      Eigen::AngleAxisd(std::atan2(forward.y(), forward.x()), Eigen::Vector3d::UnitZ())
          .toRotationMatrix();
  return T_world_body;
}

Eigen::AlignedBox3d SceneModel::bounds() const {
  Eigen::AlignedBox3d box = track_and_points();
  for (const auto& [id, feature] : map.features) {
    box.extend(mapping::surface_of(feature).bounding_box());
  }
  return box;
}

Eigen::AlignedBox3d SceneModel::track_and_points() const {
  Eigen::AlignedBox3d box;
  for (const auto& [key, block] : points.blocks) {
    if (block.points && !block.points->empty()) box.extend(block.box);
  }
  for (const auto& [id, T_world_camera] : track.keyframes) box.extend(T_world_camera.translation());
  if (track.newest) box.extend(track.newest->T_world_camera.translation());
  return box;
}

}  // namespace geomap::viewer
