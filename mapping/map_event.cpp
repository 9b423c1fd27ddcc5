// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map_event.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace geomap::mapping {
namespace {

constexpr double kOrthonormal = 1e-6;

EventFault find_fault(const Eigen::Isometry3d& pose) {
  if (!pose.matrix().allFinite()) return EventFault::kNotFinite;
  const Eigen::Matrix3d R = pose.linear();
  const bool rigid = (R * R.transpose() - Eigen::Matrix3d::Identity()).norm() < kOrthonormal &&
                     R.determinant() > 0.0;
  return rigid ? EventFault::kNone : EventFault::kNotRigid;
}

EventFault find_fault(const geometry::PlaneObservation& plane) {
  const geometry::PlaneFrame& frame = plane.surface.frame;
  const std::array<double, 16> moments = plane.moments.to_array();
  const bool finite =
      plane.surface.plane.normal.allFinite() && std::isfinite(plane.surface.plane.d) &&
      frame.origin.allFinite() && frame.x_axis.allFinite() && frame.normal.allFinite() &&
      std::isfinite(plane.rms) &&
      std::all_of(moments.begin(), moments.end(), [](double m) { return std::isfinite(m); }) &&
      std::all_of(plane.color.begin(), plane.color.end(),
                  [](double c) { return std::isfinite(c); });
  if (!finite) return EventFault::kNotFinite;
  const bool sound = std::abs(plane.surface.plane.normal.norm() - 1.0) < kOrthonormal &&
                     std::abs(frame.normal.norm() - 1.0) < kOrthonormal &&
                     std::abs(frame.x_axis.norm() - 1.0) < kOrthonormal &&
                     std::abs(frame.x_axis.dot(frame.normal)) < kOrthonormal &&
                     plane.surface.plane.normal.dot(frame.normal) > 0.5 &&
                     plane.moments.weight > 0.0 && plane.inliers > 0 &&
                     !plane.surface.polygon.empty() &&
                     geometry::find_fault(plane.surface.polygon).empty();
  return sound ? EventFault::kNone : EventFault::kBadPolygon;
}

}  // namespace

std::string to_string(EventFault fault) {
  switch (fault) {
    case EventFault::kNone:
      return "none";
    case EventFault::kNotFinite:
      return "not_finite";
    case EventFault::kNotRigid:
      return "not_rigid";
    case EventFault::kBadPolygon:
      return "bad_polygon";
    case EventFault::kAlreadyObserved:
      return "already_observed";
    case EventFault::kRemoved:
      return "removed";
    case EventFault::kCompacted:
      return "compacted";
  }
  return "unknown";
}

EventFault find_fault(const MapEvent& event) {
  if (const auto* observation = std::get_if<std::shared_ptr<const Observation>>(&event)) {
    EventFault fault = find_fault((*observation)->T_world_camera);
    for (const geometry::PlaneObservation& plane : (*observation)->planes) {
      if (fault == EventFault::kNone) fault = find_fault(plane);
    }
    return fault;
  }
  if (const auto* correction = std::get_if<PoseCorrection>(&event)) {
    for (const auto& [keyframe, pose] : correction->poses) {
      const EventFault fault = find_fault(pose);
      if (fault != EventFault::kNone) return fault;
    }
  }
  return EventFault::kNone;
}

}  // namespace geomap::mapping
