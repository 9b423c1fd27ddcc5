// SPDX-License-Identifier: BSD-3-Clause
#include "logs/pose_pairs.hpp"

#include <random>

namespace geomap::testing {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using logs::PosePair;

Isometry3d at(const Vector3d& position, double yaw) {
  Isometry3d T(Eigen::AngleAxisd(yaw, Vector3d::UnitZ()));
  T.translation() = position;
  return T;
}

std::vector<PosePair> pairs_of(const std::vector<Vector3d>& estimate,
                               const std::vector<Vector3d>& reference) {
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    pairs.push_back({static_cast<std::int64_t>(250'000 * i), at(estimate[i]), at(reference[i])});
  }
  return pairs;
}

std::vector<PosePair> noisy_walk(unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  const auto random = [&] {
    return Vector3d(normal(generator), normal(generator), normal(generator));
  };
  std::vector<Vector3d> estimate, reference;
  Vector3d position(1000.0, -500.0, 20.0);
  for (int i = 0; i < 60; ++i) {
    position += 0.3 * random();
    reference.push_back(position);
    estimate.push_back(position + 0.05 * random());
  }
  return pairs_of(estimate, reference);
}

Isometry3d some_motion() {
  Isometry3d T(Eigen::AngleAxisd(2.2, Vector3d(1.0, -2.0, 0.5).normalized()));
  T.translation() = Vector3d(30.0, -7.0, 11.0);
  return T;
}

std::vector<PosePair> with_estimate_moved(std::vector<PosePair> pairs, const Isometry3d& T) {
  for (PosePair& pair : pairs) pair.T_world_estimate = T * pair.T_world_estimate;
  return pairs;
}

}  // namespace geomap::testing
