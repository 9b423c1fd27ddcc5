// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/true_visibility.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/angles.hpp"
#include "geometry/polygon_clip.hpp"

namespace geomap::drivers {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// The same surface as seen from behind.
SceneFace back_of(const SceneFace& face) {
  SceneFace back = face;
  back.corner = face.corner + face.u;
  back.u = -face.u;
  const double length = face.u.norm();
  for (Eigen::AlignedBox2d& opening : back.openings) {
    opening = Eigen::AlignedBox2d(Vector2d(length - opening.max().x(), opening.min().y()),
                                  Vector2d(length - opening.min().x(), opening.max().y()));
  }
  return back;
}

std::vector<Vector3d> lift(const SceneFace& face, const geometry::Ring& ring) {
  const Vector3d u = face.u.normalized();
  const Vector3d v = face.v.normalized();
  std::vector<Vector3d> points;
  for (const geometry::GridPoint vertex : ring) {
    const Vector2d at = geometry::to_metres(vertex);
    points.push_back(face.corner + at.x() * u + at.y() * v);
  }
  return points;
}

TruthPolygon lift(const SceneFace& face, const geometry::PolygonPart& part) {
  TruthPolygon polygon{lift(face, part.outer), {}};
  for (const geometry::Ring& hole : part.holes) polygon.holes.push_back(lift(face, hole));
  return polygon;
}

}  // namespace

Vector3d TrueVisibility::Side::cell_center(int column, int row) const {
  return face.corner + (column + 0.5) / columns * face.u + (row + 0.5) / rows * face.v;
}

bool TrueVisibility::Side::is_air(int column, int row) const {
  const Vector2d middle = Vector2d(column + 0.5, row + 0.5).cwiseProduct(cell_size());
  return std::any_of(face.openings.begin(), face.openings.end(),
                     [&](const Eigen::AlignedBox2d& o) { return o.contains(middle); });
}

TrueVisibility::TrueVisibility(const Scene& scene, const RayCaster& caster,
                               const geometry::CameraModel& camera, const VisibilityConfig& config)
    : caster_(caster), camera_(camera), config_(config) {
  for (const SceneSurface& surface : scene.surfaces) {
    if (surface.face < 0) continue;
    const SceneFace& face = scene.faces[static_cast<std::size_t>(surface.face)];
    add_side(surface.name, face);
    if (face.both_sides) add_side(surface.name + "_back", back_of(face));
  }
}

void TrueVisibility::add_side(const std::string& name, const SceneFace& face) {
  Side side;
  side.name = name;
  side.face = face;
  side.normal = face.u.cross(face.v).normalized();
  for (const double a : {0.0, 1.0}) {
    for (const double b : {0.0, 1.0}) side.box.extend(face.corner + a * face.u + b * face.v);
  }
  side.columns = std::max(1, static_cast<int>(std::ceil(face.u.norm() / config_.cell)));
  side.rows = std::max(1, static_cast<int>(std::ceil(face.v.norm() / config_.cell)));
  side.seen.assign(static_cast<std::size_t>(side.columns) * static_cast<std::size_t>(side.rows), 0);
  sides_.push_back(std::move(side));
}

void TrueVisibility::add(const Eigen::Isometry3d& T_world_camera) {
  if (T_world_last_) {
    const Eigen::Isometry3d step = T_world_last_->inverse() * T_world_camera;
    const double angle = Eigen::AngleAxisd(step.linear()).angle();
    if (step.translation().norm() < config_.min_translation &&
        angle < geometry::radians(config_.min_rotation_deg)) {
      return;
    }
  }
  T_world_last_ = T_world_camera;
  for (Side& side : sides_) look_at(side, T_world_camera);
}

void TrueVisibility::look_at(Side& side, const Eigen::Isometry3d& T_world_camera) const {
  const Vector3d eye = T_world_camera.translation();
  // From the camera to the farthest corner of what it sees.
  const double reach =
      config_.max_range *
      std::max(camera_.ray(0, 0).norm(), camera_.ray(camera_.width, camera_.height).norm());
  if (side.normal.dot(eye - side.face.corner) <= 0.0 || side.box.exteriorDistance(eye) > reach) {
    return;
  }
  const Eigen::Isometry3d T_camera_world = T_world_camera.inverse();
  std::size_t cell = 0;
  for (int row = 0; row < side.rows; ++row) {
    for (int column = 0; column < side.columns; ++column, ++cell) {
      if (side.seen[cell] != 0 || side.is_air(column, row)) continue;
      side.seen[cell] = is_seen(side, side.cell_center(column, row), eye, T_camera_world) ? 1 : 0;
    }
  }
}

bool TrueVisibility::is_seen(const Side& side, const Vector3d& point, const Vector3d& eye,
                             const Eigen::Isometry3d& T_camera_world) const {
  const Vector3d in_camera = T_camera_world * point;
  if (in_camera.z() < config_.min_range || in_camera.z() > config_.max_range) return false;
  const Vector2d pixel = camera_.project(in_camera);
  if (pixel.x() < -0.5 || pixel.y() < -0.5 || pixel.x() > camera_.width - 0.5 ||
      pixel.y() > camera_.height - 0.5) {
    return false;
  }
  if (side.normal.dot((eye - point).normalized()) < config_.min_cosine) return false;
  return caster_.is_free(eye, point);
}

TruthPlane TrueVisibility::truth_of(const Side& side) const {
  std::vector<geometry::Ring> runs;  // of seen cells, row by row
  const Vector2d size = side.cell_size();
  for (int row = 0; row < side.rows; ++row) {
    const auto first = side.seen.begin() + static_cast<std::ptrdiff_t>(row) * side.columns;
    const auto end = first + side.columns;
    const double low = row * size.y();
    for (auto from = std::find(first, end, 1); from != end;) {
      const auto to = std::find(from, end, 0);
      runs.push_back(
          geometry::rectangle({static_cast<double>(from - first) * size.x(), low},
                              {static_cast<double>(to - first) * size.x(), low + size.y()}));
      from = std::find(to, end, 1);
    }
  }
  const geometry::Polygon outline = outline_of(side.face);
  const geometry::Polygon visible =
      geometry::intersect(outline, geometry::from_rings(runs, geometry::FillRule::kNonZero));

  TruthPlane plane;
  plane.name = side.name;
  plane.plane = geometry::Plane::through(side.face.corner, side.normal);
  plane.area = geometry::area(outline);
  plane.visible_area = geometry::area(visible);
  plane.seen = !visible.empty();
  if (!outline.parts.empty()) plane.polygon = lift(side.face, outline.parts.front());
  for (const geometry::PolygonPart& part : visible.parts) {
    plane.visible.push_back(lift(side.face, part));
  }
  return plane;
}

Truth TrueVisibility::truth() const {
  Truth truth;
  for (const Side& side : sides_) truth.planes.push_back(truth_of(side));
  return truth;
}

}  // namespace geomap::drivers
