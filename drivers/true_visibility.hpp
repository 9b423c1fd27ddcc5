// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/ray_caster.hpp"
#include "drivers/truth.hpp"
#include "geometry/camera_model.hpp"
#include "geometry/polygon.hpp"

namespace geomap::drivers {

/// @brief What counts as seen.
struct VisibilityConfig {
  double cell = 0.02;             // size of the pieces that are looked at [m], about
  double min_range = 0.5;         // along the optical axis [m]
  double max_range = 5.0;         // [m]
  double min_cosine = 0.1;        // |n·ray|: views at less decide nothing
  double min_translation = 0.1;   // between two looks [m]: key frames are as far apart
  double min_rotation_deg = 5.0;  // or turned by this much
};

/// @brief Which parts of a scene's planes the camera could have mapped on its way: in the image,
/// within range, with nothing in between, from any pose at which there may have been a key frame.
class TrueVisibility {
 public:
  /// @param scene and caster must outlive this object.
  TrueVisibility(const Scene& scene, const RayCaster& caster, const geometry::CameraModel& camera,
                 const VisibilityConfig& config);

  /// @brief The true pose of the next frame; looks around where the camera has moved far enough.
  void add(const Eigen::Isometry3d& T_world_camera);

  /// @brief Every plane of the scene, the back of a face with two sides as NAME_back.
  Truth truth() const;

 private:
  struct Side {
    std::string name;
    SceneFace face;
    Eigen::Vector3d normal;
    Eigen::AlignedBox3d box;
    int columns = 0;
    int rows = 0;
    std::vector<std::uint8_t> seen;  // by cell, row by row
    Eigen::Vector3d cell_center(int column, int row) const;
    bool is_air(int column, int row) const;
    Eigen::Vector2d cell_size() const { return {face.u.norm() / columns, face.v.norm() / rows}; }
  };

  void add_side(const std::string& name, const SceneFace& face);
  void look_at(Side& side, const Eigen::Isometry3d& T_world_camera) const;
  bool is_seen(const Side& side, const Eigen::Vector3d& point, const Eigen::Vector3d& eye,
               const Eigen::Isometry3d& T_camera_world) const;
  TruthPlane truth_of(const Side& side) const;

  const RayCaster& caster_;
  geometry::CameraModel camera_;
  VisibilityConfig config_;
  std::vector<Side> sides_;
  std::optional<Eigen::Isometry3d> T_world_last_;
};

}  // namespace geomap::drivers
