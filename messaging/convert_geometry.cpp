// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/convert_geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace geomap::messaging {
namespace {

/// Larger polygons than any surface's: 1 km, where products of coordinates still fit 64 bits.
constexpr std::int32_t kLargestCoordinate = 10'000'000;  // [0.1 mm]
constexpr std::size_t kMostVertices = 20'000;

/// The axes of a frame may deviate from right angles by rounding only.
constexpr double kAxesTolerance = 1e-6;

Eigen::Vector3d to_vector(const double* values) {
  return Eigen::Map<const Eigen::Vector3d>(values);
}

void fill_vector(double* values, const Eigen::Vector3d& vector) {
  std::copy(vector.data(), vector.data() + 3, values);
}

Eigen::Isometry3d isometry(const double* translation, const double* wxyz) {
  const Eigen::Quaterniond rotation(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  if (!(rotation.norm() > 0.5)) throw std::invalid_argument("from_message: not a quaternion");
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = rotation.normalized().toRotationMatrix();
  T.translation() = to_vector(translation);
  return T;
}

void fill_transform(double* translation, double* wxyz, const Eigen::Isometry3d& T) {
  Eigen::Quaterniond rotation(T.linear());
  rotation.normalize();
  fill_vector(translation, T.translation());
  const std::array<double, 4> values = {rotation.w(), rotation.x(), rotation.y(), rotation.z()};
  std::copy(values.begin(), values.end(), wxyz);
}

geomap::ring_t to_ring(const geometry::Ring& ring) {
  geomap::ring_t message{};
  message.n = static_cast<std::int32_t>(ring.size());
  message.x.reserve(ring.size());
  message.y.reserve(ring.size());
  for (const geometry::GridPoint& point : ring) {
    message.x.push_back(point.x);
    message.y.push_back(point.y);
  }
  return message;
}

geometry::Ring from_ring(const geomap::ring_t& message) {
  geometry::Ring ring;
  ring.reserve(message.x.size());
  for (std::size_t i = 0; i < message.x.size(); ++i) ring.push_back({message.x[i], message.y[i]});
  return ring;
}

bool within_limits(const geometry::Ring& ring) {
  return std::all_of(ring.begin(), ring.end(), [](const geometry::GridPoint& point) {
    return point.x >= -kLargestCoordinate && point.x <= kLargestCoordinate &&
           point.y >= -kLargestCoordinate && point.y <= kLargestCoordinate;
  });
}

bool is_valid(const geometry::Polygon& polygon) {
  for (const geometry::PolygonPart& part : polygon.parts) {
    if (!within_limits(part.outer)) return false;
    if (!std::all_of(part.holes.begin(), part.holes.end(), within_limits)) return false;
  }
  return geometry::vertex_count(polygon) <= kMostVertices && geometry::find_fault(polygon).empty();
}

bool axes_at_right_angles(const geometry::PlaneFrame& frame) {
  return std::abs(frame.normal.dot(frame.x_axis)) <= kAxesTolerance;
}

}  // namespace

bot_core::rigid_transform_t to_rigid_transform(std::int64_t utime, const Eigen::Isometry3d& T) {
  bot_core::rigid_transform_t message{};
  message.utime = utime;
  fill_transform(message.trans, message.quat, T);
  return message;
}

bot_core::pose_t to_pose(std::int64_t utime, const Eigen::Isometry3d& T_local_body) {
  bot_core::pose_t message{};
  message.utime = utime;
  fill_transform(message.pos, message.orientation, T_local_body);
  return message;
}

Eigen::Isometry3d from_message(const bot_core::rigid_transform_t& message) {
  return isometry(message.trans, message.quat);
}

Eigen::Isometry3d from_message(const bot_core::pose_t& message) {
  return isometry(message.pos, message.orientation);
}

geomap::transform_t to_message(const Eigen::Isometry3d& T) {
  geomap::transform_t message{};
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(message.rotation) = T.linear();
  fill_vector(message.translation, T.translation());
  return message;
}

Eigen::Isometry3d from_message(const geomap::transform_t& message) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(message.rotation);
  T.translation() = to_vector(message.translation);
  return T;
}

geomap::camera_t to_message(const geometry::CameraModel& camera) {
  geomap::camera_t message{};
  message.width = camera.width;
  message.height = camera.height;
  message.fx = camera.fx;
  message.fy = camera.fy;
  message.cx = camera.cx;
  message.cy = camera.cy;
  return message;
}

geometry::CameraModel from_message(const geomap::camera_t& message) {
  return {message.width, message.height, message.fx, message.fy, message.cx, message.cy};
}

geomap::polygon_t to_message(const geometry::Polygon& polygon) {
  geomap::polygon_t message{};
  for (const geometry::PolygonPart& part : polygon.parts) {
    geomap::polygon_part_t& written = message.parts.emplace_back();
    written.outer = to_ring(part.outer);
    for (const geometry::Ring& hole : part.holes) written.holes.push_back(to_ring(hole));
    written.n_holes = static_cast<std::int32_t>(part.holes.size());
  }
  message.n_parts = static_cast<std::int32_t>(polygon.parts.size());
  return message;
}

geometry::Polygon from_message(const geomap::polygon_t& message) {
  geometry::Polygon polygon;
  for (const geomap::polygon_part_t& part : message.parts) {
    geometry::PolygonPart& read = polygon.parts.emplace_back();
    read.outer = from_ring(part.outer);
    for (const geomap::ring_t& hole : part.holes) read.holes.push_back(from_ring(hole));
  }
  return polygon;
}

geomap::plane_frame_t to_message(const geometry::PlaneFrame& frame) {
  geomap::plane_frame_t message{};
  fill_vector(message.origin, frame.origin);
  fill_vector(message.x_axis, frame.x_axis);
  fill_vector(message.normal, frame.normal);
  return message;
}

geometry::PlaneFrame from_message(const geomap::plane_frame_t& message) {
  return {to_vector(message.origin), to_vector(message.x_axis), to_vector(message.normal)};
}

geomap::plane_t to_message(const geometry::PlaneObservation& plane) {
  geomap::plane_t message{};
  fill_vector(message.normal, plane.surface.plane.normal);
  message.d = plane.surface.plane.d;
  const std::array<double, 16> moments = plane.moments.to_array();
  std::copy(moments.begin(), moments.end(), message.moments);
  message.frame = to_message(plane.surface.frame);
  message.polygon = to_message(plane.surface.polygon);
  message.inliers = plane.inliers;
  message.rms = plane.rms;
  std::copy(plane.color.begin(), plane.color.end(), message.color);
  return message;
}

std::optional<geometry::PlaneObservation> from_message(const geomap::plane_t& message) {
  geometry::PlaneObservation plane;
  plane.surface.plane = {to_vector(message.normal), message.d};
  plane.surface.frame = from_message(message.frame);
  plane.surface.polygon = from_message(message.polygon);
  std::array<double, 16> moments{};
  std::copy(std::begin(message.moments), std::end(message.moments), moments.begin());
  plane.moments = geometry::PlaneMoments::from_array(moments);
  plane.inliers = message.inliers;
  plane.rms = message.rms;
  std::copy(std::begin(message.color), std::end(message.color), plane.color.begin());

  if (plane.inliers < 0 || plane.rms < 0.0 || plane.moments.weight < 0.0 ||
      !axes_at_right_angles(plane.surface.frame) || !is_valid(plane.surface.polygon)) {
    return std::nullopt;
  }
  return plane;
}

geomap::plane_set_t to_message(const PlaneSet& planes) {
  geomap::plane_set_t message{};
  message.utime = planes.keyframe;
  message.session = planes.session;
  message.sequence = planes.sequence;
  message.T_world_camera = to_message(planes.T_world_camera);
  message.noise_factor = planes.noise_factor;
  message.n_planes = static_cast<std::int32_t>(planes.planes.size());
  for (const geometry::PlaneObservation& plane : planes.planes) {
    message.planes.push_back(to_message(plane));
  }
  return message;
}

std::optional<PlaneSet> from_message(const geomap::plane_set_t& message) {
  PlaneSet planes;
  planes.keyframe = message.utime;
  planes.session = message.session;
  planes.sequence = message.sequence;
  planes.T_world_camera = from_message(message.T_world_camera);
  planes.noise_factor = message.noise_factor;
  for (const geomap::plane_t& plane : message.planes) {
    std::optional<geometry::PlaneObservation> read = from_message(plane);
    if (!read) return std::nullopt;
    planes.planes.push_back(std::move(*read));
  }
  return planes;
}

}  // namespace geomap::messaging
