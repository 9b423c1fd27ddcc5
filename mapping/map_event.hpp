// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "geometry/planar_polygon.hpp"
#include "mapping/edit.hpp"

namespace geomap::mapping {

/// @brief The planes of one key frame. They stay in the camera frame, so that a corrected pose can
/// move them later.
struct Observation {
  std::int64_t keyframe = 0;  // utime [us]
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  std::vector<geometry::PlaneObservation> planes;  // camera frame
};

/// @brief Everything a key frame contributed goes.
struct KeyframeRemoval {
  std::int64_t keyframe = 0;
};

/// @brief New poses T_world_camera of key frames, for example after a loop closure.
struct PoseCorrection {
  std::vector<std::pair<std::int64_t, Eigen::Isometry3d>> poses;
};

/// @brief What changes a geometric map. Observations and edits are shared: history, copies and
/// journal hold the same one.
using MapEvent = std::variant<std::shared_ptr<const Observation>, KeyframeRemoval, PoseCorrection,
                              std::shared_ptr<const Edit>>;

/// @brief Why an event did not change the map.
enum class EventFault {
  kNone,
  kNotFinite,        // a number is not finite
  kNotRigid,         // a pose is not a rotation and a translation
  kOutOfRange,       // a pose or polygon lies farther out than the numbers reach
  kBadPolygon,       // a polygon breaks its invariant or a frame is not orthonormal
  kAlreadyObserved,  // the key frame is in the map
  kRemoved,          // the key frame was removed before
  kCompacted,        // the key frame is part of the base state, whose events are gone
  kBadEdit,          // an edit holds too much, or its number is not the next one
};
std::string to_string(EventFault fault);

/// @brief Checks a pose: finite, rigid, at most 1000 km from the origin.
EventFault find_fault(const Eigen::Isometry3d& pose);

/// @brief Checks a surface in its own right: finite, orthonormal frame, plane along the frame,
/// valid polygon that reaches at most 1 km.
EventFault find_fault(const geometry::PlanarPolygon& surface);

/// @brief Checks what needs no map: finite numbers, rigid poses, valid polygons.
EventFault find_fault(const MapEvent& event);

}  // namespace geomap::mapping
