// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/drawing_scene.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "geometry/polygon_clip.hpp"
#include "mapping/view_feature.hpp"

namespace geomap::testing {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Polygon;

constexpr std::int64_t kFirstKeyframe = 1'000'000'000'000'000;

// A flat thing of the room: where its coordinates begin, and how they run.
struct Face {
  DrawnFeature feature = kFloor;
  Vector3d origin, x_axis, normal;
  Vector2d size;
  std::array<double, 3> color;
  std::string label;
};

const std::vector<Face>& faces() {
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  const Vector3d slope = Vector3d(-0.8, 0.0, 0.6);
  static const std::vector<Face> kFaces = {
      {kFloor, {0, 0, 0}, x, z, {5, 4}, {150, 120, 90}, "floor"},
      {kWestWall, {0, 0, 0}, y, x, {4, 2.5}, {210, 205, 190}, ""},
      {kEastWall, {5, 4, 0}, -y, -x, {4, 2.5}, {210, 205, 190}, "wall"},
      {kSouthWall, {5, 0, 0}, -x, y, {5, 2.5}, {200, 195, 180}, ""},
      {kNorthWall, {0, 4, 0}, x, -y, {5, 2.5}, {205, 200, 185}, ""},
      {kCeiling, {0, 4, 2.5}, x, -z, {5, 4}, {235, 235, 230}, "ceiling"},
      {kTable, {1.6, 1.3, 0.75}, x, z, {1.6, 0.9}, {120, 70, 40}, "table"},
      {kCupboard, {4.4, 3.2, 0.2}, -y, -x, {1.2, 1.9}, {90, 110, 140}, ""},
      {kRamp, {1.0, 3.1, 0.0}, -y, slope, {0.8, 1.0}, {60, 110, 70}, ""}};
  return kFaces;
}

Polygon outline_of(const Face& face) {
  const std::vector<geometry::Ring> whole = {geometry::rectangle(Vector2d::Zero(), face.size)};
  const Polygon polygon = geometry::from_rings(whole, geometry::FillRule::kNonZero);
  std::vector<geometry::Ring> hole;
  if (face.feature == kTable) hole = {geometry::rectangle({0.9, 0.3}, {1.3, 0.65})};
  if (face.feature == kNorthWall) hole = {geometry::rectangle({1.6, 0.9}, {3.0, 1.9})};
  if (hole.empty()) return polygon;
  return geometry::subtract(polygon, geometry::from_rings(hole, geometry::FillRule::kNonZero));
}

geometry::PlanarPolygon surface_of(const Face& face, const Vector3d& corner) {
  geometry::PlanarPolygon surface;
  surface.frame = {.origin = corner + face.origin, .x_axis = face.x_axis, .normal = face.normal};
  surface.plane = surface.frame.plane();
  surface.polygon = outline_of(face);
  return surface;
}

mapping::MapFeature feature_of(const Face& face, const Vector3d& corner) {
  mapping::MapFeature feature;
  feature.id = drawn_id(face.feature);
  feature.surface = surface_of(face, corner);
  feature.observations.assign(static_cast<std::size_t>(1 + 3 * face.feature), feature.id);
  feature.color = face.color;
  feature.label = face.label;
  if (face.feature == kCupboard) feature.held_by = {1};
  return feature;
}

viewer::MapLayer map_of(const Vector3d& corner) {
  viewer::MapLayer map;
  for (const Face& face : faces()) {
    const mapping::MapFeature feature = feature_of(face, corner);
    map.features.emplace(feature.id, mapping::quantised(feature));
  }
  Face gone = faces()[kTable];
  gone.origin = {3.4, 0.5, 0.45};
  gone.size = {0.6, 0.5};
  gone.feature = kRamp;
  mapping::Veto veto{.edit = 1,
                     .cause = mapping::VetoCause::kDeleted,
                     .feature = feature_of(gone, corner),
                     .region = outline_of(gone)};
  map.vetoes.push_back(veto);
  map.stamp = map.veto_stamp = 1;
  return map;
}

// From 0 to 1: the same on every machine, which the standard distributions are not.
double share(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }

viewer::PointLayer points_of(const Vector3d& corner) {
  std::mt19937 random(1);
  std::map<viewer::BlockKey, std::vector<viewer::ScenePoint>> blocks;
  for (const Face& face : faces()) {
    const Polygon polygon = outline_of(face);
    const Vector3d y_axis = face.normal.cross(face.x_axis);
    const int points = static_cast<int>(160.0 * face.size.prod());
    for (int i = 0; i < points; ++i) {
      const Vector2d at(share(random) * face.size.x(), share(random) * face.size.y());
      if (!geometry::contains(polygon, at)) continue;
      const Vector3d local = face.origin + at.x() * face.x_axis + at.y() * y_axis +
                             0.01 * (share(random) - 0.5) * face.normal;
      const Eigen::Vector3i key = local.array().floor().cast<int>();
      viewer::ScenePoint point{.position = (corner + local).cast<float>(), .color = {}};
      for (std::size_t c = 0; c < 3; ++c) {
        point.color[c] = static_cast<std::uint8_t>(face.color[c] + 16.0 * share(random));
      }
      blocks[{key.x(), key.y(), key.z()}].push_back(point);
    }
  }
  viewer::PointLayer layer{.blocks = {}, .points = 0, .stamp = 1};
  for (auto& [key, points] : blocks) {
    viewer::PointBlock block{.points = {}, .box = {}, .stamp = 1};
    for (const auto& point : points) block.box.extend(point.position.cast<double>());
    layer.points += points.size();
    block.points = std::make_shared<const std::vector<viewer::ScenePoint>>(std::move(points));
    layer.blocks.emplace(key, std::move(block));
  }
  return layer;
}

// Level, heading counter-clockwise from x.
Eigen::Isometry3d camera_at(const Vector3d& position, double heading) {
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  const Vector3d forward(std::cos(heading), std::sin(heading), 0.0);
  T_world_camera.linear().col(0) = forward.cross(Vector3d::UnitZ());
  T_world_camera.linear().col(1) = -Vector3d::UnitZ();
  T_world_camera.linear().col(2) = forward;
  T_world_camera.translation() = position;
  return T_world_camera;
}

viewer::TrackLayer track_of(const Vector3d& corner) {
  viewer::TrackLayer track;
  for (int i = 0; i <= 40; ++i) {
    const double angle = -0.9 + 0.04 * i;
    const Vector3d position =
        corner + Vector3d(2.4 + 1.6 * std::cos(angle), 1.9 + 1.3 * std::sin(angle), 1.1);
    const std::int64_t utime = kFirstKeyframe + 100'000 * i;
    track.newest = {utime, camera_at(position, angle + 0.5 * std::numbers::pi)};
    track.poses.push_back(*track.newest);
    if (i % 8 == 0) track.keyframes.emplace(utime, track.newest->T_world_camera);
  }
  track.camera = geometry::CameraModel{640, 480, 525.0, 525.0, 319.5, 239.5};
  track.stamp = 1;
  return track;
}

viewer::PlanesLayer planes_of(const Vector3d& corner) {
  viewer::PlanesLayer layer;
  Face wall = faces()[kNorthWall];
  wall.feature = kCupboard;
  wall.origin += Vector3d(0.3, -0.04, 0.2);
  wall.size = {1.2, 1.8};
  Face floor = faces()[kFloor];
  floor.origin += Vector3d(0.4, 2.2, 0.01);
  floor.size = {2.6, 1.6};
  Face unknown = faces()[kFloor];
  unknown.origin = {3.2, 2.6, 1.0};
  unknown.size = {0.8, 0.7};
  for (const Face& face : {wall, floor, unknown}) layer.planes.push_back(surface_of(face, corner));
  layer.keyframe = kFirstKeyframe;
  layer.stamp = 1;
  return layer;
}

viewer::FrameLayer frame_of(const Eigen::Isometry3d& T_world_camera) {
  auto frame = std::make_shared<geometry::RgbdFrame>();
  frame->depth = {.width = 80, .height = 60, .millimetres = {}};
  frame->color = {.width = 80, .height = 60, .rgb = {}};
  frame->depth_camera = {80, 60, 65.6, 65.6, 39.5, 29.5};
  for (int v = 0; v < 60; ++v) {
    for (int u = 0; u < 80; ++u) {
      frame->depth.millimetres.push_back(
          static_cast<std::uint16_t>(u % 20 == 0 ? 0 : 1400 + 4 * u));
      for (const int value : {3 * u, 4 * v, 90}) {
        frame->color.rgb.push_back(static_cast<std::uint8_t>(value));
      }
    }
  }
  viewer::FrameLayer layer;
  layer.frame = frame;
  layer.T_world_camera = T_world_camera;
  layer.stamp = 1;
  return layer;
}

viewer::ViewCamera view_from(const viewer::Viewpoint& viewpoint) {
  viewer::ViewCamera camera;
  camera.resize(320, 200);
  camera.set(viewpoint);
  return camera;
}

}  // namespace

mapping::FeatureId drawn_id(DrawnFeature feature) {
  return {kFirstKeyframe + 33'333 * feature, feature};
}

viewer::SceneModel drawing_scene(const Vector3d& corner) {
  viewer::SceneModel scene;
  scene.map = map_of(corner);
  scene.points = points_of(corner);
  scene.track = track_of(corner);
  scene.planes = planes_of(corner);
  scene.frame = frame_of(scene.track.newest->T_world_camera);
  return scene;
}

viewer::ViewCamera oblique_view(const Vector3d& corner) {
  return view_from({.target = corner + Vector3d(2.5, 2.0, 0.7),
                    .distance = 7.4,
                    .yaw = -2.25,
                    .pitch = 0.62,
                    .projection = viewer::Projection::kPerspective});
}

viewer::ViewCamera top_view() {
  return view_from({.target = {2.5, 2.0, 0.0},
                    .distance = 5.2,
                    .yaw = -0.5 * std::numbers::pi,
                    .pitch = 0.5 * std::numbers::pi,
                    .projection = viewer::Projection::kOrthographic});
}

viewer::ViewCamera near_view() {
  return view_from({.target = {2.5, 1.8, 0.75},
                    .distance = 1.9,
                    .yaw = -1.9,
                    .pitch = 0.4,
                    .projection = viewer::Projection::kPerspective});
}

}  // namespace geomap::testing
