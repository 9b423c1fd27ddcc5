// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map_event.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace geomap::mapping {
namespace {

constexpr double kOrthonormal = 1e-6;

constexpr std::int64_t kLastTime = std::int64_t{1} << 62;  // [us]
constexpr double kFarthest = 1e6;                     // of a camera from the world's origin [m]
constexpr std::int32_t kFarthestVertex = 10'000'000;  // of a polygon's frame, 1 km [0.1 mm]

bool is_within_reach(const geometry::Polygon& polygon) {
  return std::all_of(polygon.parts.begin(), polygon.parts.end(), [](const auto& part) {
    return std::all_of(part.outer.begin(), part.outer.end(), [](geometry::GridPoint p) {
      return std::max({p.x, -p.x, p.y, -p.y}) <= kFarthestVertex;
    });
  });
}

EventFault plane_fault(const geometry::PlaneObservation& plane) {
  const std::array<double, 16> moments = plane.moments.to_array();
  const bool finite =
      std::isfinite(plane.rms) &&
      std::all_of(moments.begin(), moments.end(), [](double m) { return std::isfinite(m); }) &&
      std::all_of(plane.color.begin(), plane.color.end(),
                  [](double c) { return std::isfinite(c); });
  if (!finite) return EventFault::kNotFinite;
  if (!(plane.moments.weight > 0.0) || plane.inliers <= 0) return EventFault::kBadPolygon;
  return find_fault(plane.surface);
}

// Commands are looked at more closely before they become edits.
EventFault edit_fault(const Edit& edit) {
  for (const Eigen::Vector3d& point : edit.points) {
    if (!point.allFinite()) return EventFault::kNotFinite;
    if (point.norm() > 2.0 * kFarthest) return EventFault::kOutOfRange;
  }
  const bool has_empty_target = std::any_of(edit.targets.begin(), edit.targets.end(),
                                            [](const auto& target) { return target.empty(); });
  if (edit.number < 1 || edit.after > kLastTime || has_empty_target ||
      edit.edits.size() > kMostTargets * kMostEdits || edit.targets.size() > kMostTargets ||
      edit.points.size() > kMostCorners || edit.label.size() > kLongestLabel ||
      edit.author.size() > kLongestAuthor) {
    return EventFault::kBadEdit;
  }
  const EventFault anchor = find_fault(edit.T_world_anchor);
  return anchor != EventFault::kNone ? anchor : find_fault(edit.T_anchor_moved);
}

}  // namespace

EventFault find_fault(const Eigen::Isometry3d& pose) {
  if (!pose.matrix().allFinite()) return EventFault::kNotFinite;
  const Eigen::Matrix3d R = pose.linear();
  const bool rigid = (R * R.transpose() - Eigen::Matrix3d::Identity()).norm() < kOrthonormal &&
                     R.determinant() > 0.0;
  if (!rigid) return EventFault::kNotRigid;
  return pose.translation().norm() <= kFarthest ? EventFault::kNone : EventFault::kOutOfRange;
}

EventFault find_fault(const geometry::PlanarPolygon& surface) {
  const geometry::PlaneFrame& frame = surface.frame;
  const bool finite = surface.plane.normal.allFinite() && std::isfinite(surface.plane.d) &&
                      frame.origin.allFinite() && frame.x_axis.allFinite() &&
                      frame.normal.allFinite();
  if (!finite) return EventFault::kNotFinite;
  if (frame.origin.norm() > 2.0 * kFarthest || !is_within_reach(surface.polygon)) {
    return EventFault::kOutOfRange;
  }
  const bool sound = std::abs(surface.plane.normal.norm() - 1.0) < kOrthonormal &&
                     std::abs(frame.normal.norm() - 1.0) < kOrthonormal &&
                     std::abs(frame.x_axis.norm() - 1.0) < kOrthonormal &&
                     std::abs(frame.x_axis.dot(frame.normal)) < kOrthonormal &&
                     std::abs(surface.plane.normal.dot(frame.normal)) > 0.5 &&
                     !surface.polygon.empty() && geometry::find_fault(surface.polygon).empty();
  return sound ? EventFault::kNone : EventFault::kBadPolygon;
}

std::string to_string(EventFault fault) {
  switch (fault) {
    case EventFault::kNone:
      return "none";
    case EventFault::kNotFinite:
      return "not_finite";
    case EventFault::kNotRigid:
      return "not_rigid";
    case EventFault::kOutOfRange:
      return "out_of_range";
    case EventFault::kBadPolygon:
      return "bad_polygon";
    case EventFault::kAlreadyObserved:
      return "already_observed";
    case EventFault::kRemoved:
      return "removed";
    case EventFault::kCompacted:
      return "compacted";
    case EventFault::kBadEdit:
      return "bad_edit";
  }
  return "unknown";
}

EventFault find_fault(const MapEvent& event) {
  if (const auto* observation = std::get_if<std::shared_ptr<const Observation>>(&event)) {
    EventFault fault = find_fault((*observation)->T_world_camera);
    for (const geometry::PlaneObservation& plane : (*observation)->planes) {
      if (fault == EventFault::kNone) fault = plane_fault(plane);
    }
    return fault;
  }
  if (const auto* edit = std::get_if<std::shared_ptr<const Edit>>(&event)) {
    return edit_fault(**edit);
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
