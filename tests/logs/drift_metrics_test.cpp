// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/angles.hpp"
#include "logs/pose_pairs.hpp"
#include "logs/trajectory_metrics.hpp"

namespace geomap::logs {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using geometry::radians;
using testing::at;
using testing::noisy_walk;
using testing::pairs_of;
using testing::some_motion;
using testing::with_estimate_moved;

TEST(AnchoredError, IsZeroForTheSamePathInAnotherWorld) {
  auto pairs = noisy_walk(3);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pairs[i].T_world_reference.rotate(
        Eigen::AngleAxisd(0.1 * static_cast<double>(i), Vector3d(1, 1, 0).normalized()));
    pairs[i].T_world_estimate = some_motion() * pairs[i].T_world_reference;
  }
  EXPECT_LT(anchored_error(pairs).statistics.max, 1e-9);
  EXPECT_LT(aligned_error(pairs).statistics.max, 1e-9);
}

// Three metres along x; only the first pose is seen 10° to the left. Anchoring turns the whole path
// by 10° to the right: the pose at r metres moves by 2 r sin 5°, the last by 6 sin 5°, and is 10°
// off.
TEST(AnchoredError, AFirstPoseThatIsTurnedSwingsTheWholePath) {
  Trajectory reference, estimate;
  for (int i = 0; i <= 3; ++i) {
    const Vector3d position(i, 0, 0);
    reference.emplace_back(1'000'000 * i, at(position));
    estimate.emplace_back(1'000'000 * i, at(position, i == 0 ? radians(10.0) : 0.0));
  }
  const TrajectoryMetrics metrics = compare_trajectories(estimate, reference, 0.02);
  const double chord = 2.0 * std::sin(radians(5.0));
  EXPECT_THAT(metrics.anchored.errors,
              ::testing::Pointwise(::testing::DoubleNear(1e-12),
                                   std::vector<double>{0.0, chord, 2 * chord, 3 * chord}));
  EXPECT_NEAR(metrics.anchored.statistics.rmse, chord * std::sqrt(14.0 / 4.0), 1e-12);
  EXPECT_NEAR(metrics.anchored.statistics.median, 1.5 * chord, 1e-12);
  EXPECT_NEAR(metrics.end.translation, 3 * chord, 1e-12);
  EXPECT_NEAR(metrics.end.rotation, radians(10.0), 1e-12);
  EXPECT_NEAR(metrics.aligned.statistics.max, 0.0, 1e-12);  // the positions themselves are right
}

// Ten poses 0.25 m and 0.25 s apart; every step of the estimate is 0.25 m · 1.02 and then turns by
// 0.01 rad. After four steps: 0.04 rad; along x 0.255 Σ cos 0.01 k and along y 0.255 Σ sin 0.01 k
// for k = 0..3, against 1 m. Six pairs, all alike.
TEST(RelativeError, OfAConstantDriftIsThatDrift) {
  std::vector<PosePair> pairs;
  PosePair pair;
  for (int i = 0; i < 10; ++i) {
    pair.utime = 7'000'000 + 250'000 * i;
    pairs.push_back(pair);
    pair.T_world_reference = pair.T_world_reference * at({0.25, 0, 0});
    pair.T_world_estimate = pair.T_world_estimate * at({1.02 * 0.25, 0, 0}, 0.01);
  }
  double x = -1.0, y = 0.0;
  for (int k = 0; k < 4; ++k) {
    x += 0.255 * std::cos(0.01 * k);
    y += 0.255 * std::sin(0.01 * k);
  }
  const double drift = std::hypot(x, y);
  for (const RelativeError& error :
       {error_per_metre(pairs), error_per_second(with_estimate_moved(pairs, some_motion()))}) {
    EXPECT_EQ(error.translation.count, 6U);
    EXPECT_EQ(error.rotation.count, 6U);
    for (const double value :
         {error.translation.rmse, error.translation.median, error.translation.max}) {
      EXPECT_NEAR(value, drift, 1e-9);
    }
    for (const double value : {error.rotation.rmse, error.rotation.median, error.rotation.max}) {
      EXPECT_NEAR(value, 0.04, 1e-9);
    }
  }
}

TEST(RelativeError, OfAScaleErrorIsTheScaleError) {
  std::vector<Vector3d> reference, estimate;
  for (int i = 0; i < 31; ++i) {
    reference.emplace_back(0.1 * i, 0, 0);
    estimate.emplace_back(1.03 * 0.1 * i, 0, 0);
  }
  const RelativeError error = error_per_metre(pairs_of(estimate, reference));
  EXPECT_EQ(error.translation.count, 21U);
  EXPECT_NEAR(error.translation.rmse, 0.03, 1e-9);
  EXPECT_NEAR(error.translation.max, 0.03, 1e-9);
  EXPECT_EQ(error.rotation.max, 0.0);
}

// To and fro: ten times 0.1 adds up to 1 - 10^-16.
TEST(RelativeError, TenStepsOfATenthOfAMetreAreAMetre) {
  std::vector<Vector3d> path;
  for (int i = 0; i <= 10; ++i) path.emplace_back(i % 2 == 0 ? 0.0 : 0.1, 0, 0);
  EXPECT_EQ(error_per_metre(pairs_of(path, path)).translation.count, 1U);
}

// At 0 s the nearest to 1 s is 0.9 s, at 0.9 s the nearest to 1.9 s is 2.0 s. From 2.0, 2.4 and 4.0
// s on there is none within 0.25 s of a second. The estimate gains 0.1 m, then 0.2 m.
TEST(RelativeError, SparsePosesAreComparedWhereASecondIsNearlyMet) {
  const std::vector<std::int64_t> utimes = {0, 900'000, 2'000'000, 2'400'000, 4'000'000};
  const std::vector<double> gained = {0.0, 0.1, 0.3, 5.0, 9.0};
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i < utimes.size(); ++i) {
    pairs.push_back({utimes[i], at({gained[i], 0, 0}), Isometry3d::Identity()});
  }
  const RelativeError error = error_per_second(pairs);
  EXPECT_EQ(error.translation.count, 2U);
  EXPECT_NEAR(error.translation.rmse, std::sqrt((0.01 + 0.04) / 2.0), 1e-12);
  EXPECT_NEAR(error.translation.median, 0.15, 1e-12);
  EXPECT_NEAR(error.translation.max, 0.2, 1e-12);
  EXPECT_EQ(error_per_metre(pairs).translation.count, 0U);  // the reference is at rest
}

}  // namespace
}  // namespace geomap::logs
