// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/camera_model.hpp"
#include "perception/depth_cells.hpp"
#include "perception/depth_tolerance.hpp"

namespace geomap::perception {

/// @brief What the surroundings of a cell say about its surface.
struct CellNormal {
  enum class Kind : unsigned char {
    kNone,    // too few readings, or a depth step within the cell itself
    kRough,   // readings, but the surroundings are not flat
    kPlanar,  // `normal` holds
  };
  Kind kind = Kind::kNone;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit, towards the camera

  /// @brief False where the cell's own normal says that it is not on a plane with this one.
  /// @param cosine of the largest angle between them
  bool allows(const Eigen::Vector3d& of_plane, double cosine) const {
    return kind != Kind::kPlanar || normal.dot(of_plane) >= cosine;
  }
};

/// @brief One normal per cell, from the smallest window of cells that is large enough for a normal
/// good to about 5° under the frame's noise. Where a window at the cell's centre crosses an edge,
/// the flattest of eight windows beside the cell serves, so that normals stay sharp at creases and
/// depth steps.
std::vector<CellNormal> estimate_normals(const DepthCells& cells,
                                         const geometry::CameraModel& camera,
                                         const DepthTolerance& tolerance);

}  // namespace geomap::perception
