// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "logs/trajectory_metrics.hpp"

namespace geomap::testing {

Eigen::Isometry3d at(const Eigen::Vector3d& position, double yaw = 0.0);

/// @brief Pairs a quarter of a second apart, without turning.
std::vector<logs::PosePair> pairs_of(const std::vector<Eigen::Vector3d>& estimate,
                                     const std::vector<Eigen::Vector3d>& reference);

/// @brief A random walk, and an estimate of it that is off by some centimetres in every position.
std::vector<logs::PosePair> noisy_walk(unsigned seed);

/// @brief Some motion that is neither small nor about an axis.
Eigen::Isometry3d some_motion();

std::vector<logs::PosePair> with_estimate_moved(std::vector<logs::PosePair> pairs,
                                                const Eigen::Isometry3d& T);

}  // namespace geomap::testing
