// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace geomap::perception {

/// @brief One piece of the map's surface: mean of a voxel's points and their mean normal, world.
struct Surfel {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // [m]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();    // unit, to the side it was seen from
};

}  // namespace geomap::perception
