// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "geometry/depth_noise.hpp"
#include "geometry/planar_polygon.hpp"
#include "geometry/rgbd_frame.hpp"

namespace geomap::perception {

/// @brief Label of a pixel or cell without a plane.
inline constexpr std::int16_t kNoPlane = -1;
/// @brief As many planes as labels can name.
inline constexpr std::size_t kMostPlanes = std::numeric_limits<std::int16_t>::max();

/// @brief The planes of one frame, camera frame, largest (by inliers) first.
struct ExtractedPlanes {
  std::vector<geometry::PlaneObservation> planes;
  // Per pixel, row by row: index into `planes`, or kNoPlane. Empty for an empty frame.
  std::vector<std::int16_t> label;
  geometry::DepthNoise noise;  // in force for this frame, its factor estimated where configured
  double extraction_seconds = 0.0;  // wall clock, for profiling only: everything but the outlines
  double hull_seconds = 0.0;        // wall clock, for profiling only: outlines
};

/// @brief Finds planar surfaces and their outlines in one depth frame. Implementations are
/// functions of their arguments alone: same frame and seed, same planes to the last bit; safe to
/// call from several threads at once.
class PlaneExtractor {
 public:
  virtual ~PlaneExtractor() = default;

  /// @param seed of everything random; the key frame's id.
  /// @param up_camera the world's up direction in the camera frame, needed only where the
  /// orientation of planes is constrained.
  virtual ExtractedPlanes extract(const geometry::RgbdFrame& frame, std::uint64_t seed,
                                  const std::optional<Eigen::Vector3d>& up_camera) const = 0;

  /// @brief The same for a key frame of this id and pose (world z up).
  ExtractedPlanes extract_keyframe(const geometry::RgbdFrame& frame, std::int64_t keyframe,
                                   const Eigen::Isometry3d& T_world_camera) const {
    const Eigen::Vector3d up_camera =
        T_world_camera.linear().transpose() * Eigen::Vector3d::UnitZ();
    return extract(frame, static_cast<std::uint64_t>(keyframe), up_camera);
  }
};

}  // namespace geomap::perception
