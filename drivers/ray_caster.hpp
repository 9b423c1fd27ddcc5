// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <vector>

#include "drivers/depth_sensor_model.hpp"
#include "drivers/scene.hpp"
#include "geometry/camera_model.hpp"

namespace geomap::drivers {

/// @brief What every pixel of a camera sees.
struct SceneView {
  ExactDepth depth;
  std::vector<std::int32_t> triangle;  // index in the scene, -1: nothing
};

/// @brief Casts rays into a scene with Embree.
///
/// Embree says only which triangle a ray hits; where, is computed here in double from the
/// triangle's plane, because Embree's own distance differs in its last bits between processors. So
/// may its choice beside an edge: there it is made again, in double, among what the pixels around
/// see.
class RayCaster {
 public:
  /// @param scene must outlive this object.
  /// @throws std::runtime_error when Embree cannot be started.
  explicit RayCaster(const Scene& scene);
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  /// @brief The view of a camera, into `view`, whose memory is reused.
  void cast(const geometry::CameraModel& camera, const Eigen::Isometry3d& T_world_camera,
            SceneView& view) const;

  /// @brief True when nothing lies between the two points [m, world], except within a millimetre of
  /// `to`.
  bool is_free(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

 private:
  struct Embree;

  double depth_of(int triangle, const Eigen::Vector3d& origin,
                  const Eigen::Vector3d& direction) const;
  int settled(const std::vector<int>& picked, const geometry::CameraModel& camera, int u, int v,
              const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;
  bool is_inside(int triangle, const Eigen::Vector3d& origin,
                 const Eigen::Vector3d& direction) const;

  const Scene& scene_;
  std::vector<Eigen::Vector4d> planes_;  // normal and d of each triangle, n·x + d = 0, world
  std::unique_ptr<Embree> embree_;
};

}  // namespace geomap::drivers
