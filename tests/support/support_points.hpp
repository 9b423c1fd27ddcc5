// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "geometry/rgbd_frame.hpp"
#include "mapping/map_feature.hpp"

namespace geomap::testing {

/// @brief Measured points, thinned to one for each centimetre cube, that tell how much of a map is
/// supported by measurements. Brute force, independent of the code under test.
class SupportPoints {
 public:
  void add(const geometry::RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera);

  /// @brief True when a point lies within `radius` [m].
  bool near(const Eigen::Vector3d& p, double radius) const;

  /// @brief Share of the features' area, sampled on a 2 cm grid, that is within `radius` of points.
  double supported_share(const std::vector<mapping::MapFeature>& features, double radius) const;

 private:
  using Cube = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const Cube& cube) const {
      return static_cast<std::size_t>(cube[0] * 73856093 ^ cube[1] * 19349663 ^ cube[2] * 83492791);
    }
  };
  static Cube cube_of(const Eigen::Vector3d& p);

  std::unordered_map<Cube, Eigen::Vector3d, Hash> points_;
};

}  // namespace geomap::testing
