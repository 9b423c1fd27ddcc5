// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>

#include "geometry/rgbd_frame.hpp"

namespace geomap::bench {

enum class PclMethod { kGicp, kPointToPlane, kPointToPoint };

/// @brief A frame made ready for PCL's registration, as source and as target alike: voxel filter of
/// 5 cm, kd-tree, and what the method needs of each point: covariances of 20 neighbours (GICP),
/// normals of 12 neighbours (point to plane), nothing (point to point).
class PclFrame {
 public:
  PclFrame(const geometry::RgbdFrame& frame, PclMethod method);

  struct Prepared;
  const Prepared& prepared() const { return *prepared_; }
  PclMethod method() const { return method_; }

 private:
  PclMethod method_;
  std::shared_ptr<const Prepared> prepared_;
};

/// @brief PCL's registration of two frames prepared for the same method, partners at most 0.2 m
/// apart, one thread. @return T_target_source; nothing when PCL says that it has not converged.
std::optional<Eigen::Isometry3d> pcl_align(const PclFrame& source, const PclFrame& target,
                                           const Eigen::Isometry3d& T_target_source_guess);

}  // namespace geomap::bench
