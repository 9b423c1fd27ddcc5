// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/sound_geometry.hpp"

#include <algorithm>
#include <cmath>

#include "mapping/map_event.hpp"

namespace geomap::viewer {
namespace {

using mapping::EventFault;

constexpr double kFarthest = 100e3;      // from the world's origin [m]
constexpr double kFarthestOffset = 1e3;  // of a frame's origin from its plane [m]
constexpr int kLargestImage = 20'000;    // [pixel]
constexpr double kImageSizes = 100.0;    // longest focal length, farthest centre

}  // namespace

bool is_sound(const Eigen::Isometry3d& T) {
  return mapping::find_fault(T) == EventFault::kNone && T.translation().norm() <= kFarthest;
}

bool is_sound(const geometry::PlanarPolygon& surface) {
  return mapping::find_fault(surface) == EventFault::kNone &&
         surface.frame.origin.norm() <= kFarthest &&
         std::abs(surface.plane.signed_distance(surface.frame.origin)) <= kFarthestOffset;
}

bool is_sound(const geometry::CameraModel& camera) {
  if (!camera.valid() || std::max(camera.width, camera.height) > kLargestImage) return false;
  const double most = kImageSizes * std::max(camera.width, camera.height);
  return std::max(camera.fx, camera.fy) <= most && std::min(camera.fx, camera.fy) >= 1.0 &&
         std::max(std::abs(camera.cx), std::abs(camera.cy)) <= most;
}

}  // namespace geomap::viewer
